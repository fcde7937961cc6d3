#include "lab/app/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace manylights::lab::app {
namespace {

struct Oklab {
    float l, a, b;
};

// Oklab (Ottosson, "A perceptual color space for image processing", 2020): to linear sRGB and back.
std::array<float, 3> linear_from_oklab(Oklab c) {
    const auto cube = [](float x) { return x * x * x; };
    const float l = cube(c.l + 0.3963377774f * c.a + 0.2158037573f * c.b);
    const float m = cube(c.l - 0.1055613458f * c.a - 0.0638541728f * c.b);
    const float s = cube(c.l - 0.0894841775f * c.a - 1.2914855480f * c.b);
    return {4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s,
            -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
            -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s};
}

std::uint8_t encode(float linear) {
    const float x = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(encoded * 255.0f));
}

float decode(std::uint8_t encoded) {
    const float x = static_cast<float>(encoded) / 255.0f;
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

bool in_gamut(const std::array<float, 3>& linear) {
    return std::all_of(linear.begin(), linear.end(), [](float x) { return x >= -1e-4f && x <= 1.0001f; });
}

// A colour outside of sRGB loses chroma until it fits; its lightness stays, since that carries the value.
Rgb fit(Oklab color) {
    float keep = 1.0f;
    while (keep > 0.0f && !in_gamut(linear_from_oklab({color.l, color.a * keep, color.b * keep}))) keep -= 0.02f;
    keep = std::max(keep, 0.0f);
    const auto linear = linear_from_oklab({color.l, color.a * keep, color.b * keep});
    return {encode(linear[0]), encode(linear[1]), encode(linear[2])};
}

// Night blue, violet, crimson, orange, pale yellow. Hue turns one way only, and lightness is not listed: it is linear.
constexpr float kDarkest = 0.17f, kBrightest = 0.97f;
constexpr std::array<std::array<float, 2>, 6> kHues = {
    {{0.005f, -0.075f}, {0.080f, -0.145f}, {0.180f, -0.060f}, {0.165f, 0.085f}, {0.055f, 0.160f}, {-0.025f, 0.105f}}};

float catmull_rom(float p0, float p1, float p2, float p3, float t) {
    return 0.5f * (2.0f * p1 + (p2 - p0) * t + (2.0f * p0 - 5.0f * p1 + 4.0f * p2 - p3) * t * t +
                   (3.0f * p1 - p0 - 3.0f * p2 + p3) * t * t * t);
}

Rgb evaluate(float value) {
    constexpr int kLast = static_cast<int>(kHues.size()) - 1;
    const float position = value * static_cast<float>(kLast);
    const int segment = std::min(static_cast<int>(position), kLast - 1);
    const float t = position - static_cast<float>(segment);
    const auto channel = [&](std::size_t axis) {
        const auto hue = [&](int i) { return kHues[static_cast<std::size_t>(std::clamp(i, 0, kLast))][axis]; };
        return catmull_rom(hue(segment - 1), hue(segment), hue(segment + 1), hue(segment + 2), t);
    };
    return fit({kDarkest + (kBrightest - kDarkest) * value, channel(0), channel(1)});
}

} // namespace

Rgb heat_color(float value) {
    constexpr int kSteps = 256;
    static const std::array<Rgb, kSteps> table = [] {
        std::array<Rgb, kSteps> colors;
        for (int i = 0; i < kSteps; ++i)
            colors[static_cast<std::size_t>(i)] = evaluate(static_cast<float>(i) / (kSteps - 1));
        return colors;
    }();
    if (!(value > 0.0f)) return table[0];
    return table[static_cast<std::size_t>(std::lround(std::min(value, 1.0f) * (kSteps - 1)))];
}

float lightness(Rgb color) {
    const float r = decode(color.r), g = decode(color.g), b = decode(color.b);
    const float l = std::cbrt(0.4122214708f * r + 0.5363325363f * g + 0.0514459929f * b);
    const float m = std::cbrt(0.2119034982f * r + 0.6806995451f * g + 0.1073969566f * b);
    const float s = std::cbrt(0.0883024619f * r + 0.2817188376f * g + 0.6299787005f * b);
    return 0.2104542553f * l + 0.7936177850f * m - 0.0040720468f * s;
}

} // namespace manylights::lab::app
