#include "lab/renderer/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace manylights::lab {

namespace {

using Color = std::array<float, 3>;

constexpr float kMiddleGrey = 0.18f;
// Pixels darker than this part of the brightest ones count as if they were that bright: a dark hall with one lamp keeps
// its darkness.
constexpr float kDarkest = 1.0f / 64.0f;
// Nor are the brightest ones exposed beyond this, where the filmic curve reaches 0.9.
constexpr float kBrightest = 2.0f;
constexpr Color kSkyTop{0.004f, 0.007f, 0.018f};
constexpr Color kSkyBottom{0.030f, 0.038f, 0.060f};
constexpr std::array<std::uint8_t, 3> kNotFinite{255, 0, 255}; // a mistake should be seen

float luminance(const float* rgb) { return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2]; } // Rec. 709

// Narkowicz 2015, a fit of the ACES reference curve.
float filmic(float x) { return std::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f); }

// IEC 61966-2-1
std::uint8_t encode_srgb(float linear) {
    const float encoded = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
    return std::uint8_t(std::clamp(encoded, 0.0f, 1.0f) * 255.0f + 0.5f);
}

Color sky(std::uint32_t y, std::uint32_t height) {
    const float t = (float(y) + 0.5f) / float(height);
    Color color{};
    for (std::size_t c = 0; c < 3; ++c) color[c] = kSkyTop[c] + (kSkyBottom[c] - kSkyTop[c]) * t * t;
    return color;
}

void write_pixel(std::uint8_t* target, const float* rgb, float exposure) {
    if (!(std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]))) {
        std::copy(kNotFinite.begin(), kNotFinite.end(), target);
        return;
    }
    // Far beyond white all is white, and the curve's squares stay finite.
    for (int c = 0; c < 3; ++c) target[c] = encode_srgb(filmic(std::clamp(rgb[c] * exposure, 0.0f, 1e6f)));
}

} // namespace

float auto_exposure(std::span<const float> radiance, std::span<const std::uint8_t> shaded) {
    std::vector<float> values;
    for (std::size_t i = 0; i < shaded.size(); ++i) {
        const float value = luminance(&radiance[3 * i]);
        if (shaded[i] != 0 && value > 0.0f && std::isfinite(value)) values.push_back(value);
    }
    if (values.empty()) return 1.0f;
    const auto bright = values.begin() + std::ptrdiff_t(values.size() - 1 - values.size() / 50);
    std::nth_element(values.begin(), bright, values.end());
    const float brightest = *bright;
    const float darkest = std::max(brightest * kDarkest, 1e-20f);
    double sum = 0.0;
    for (const float value : values) sum += std::log(double(std::max(value, darkest)));
    const double middle = std::exp(sum / double(values.size()));
    return float(std::min(double(kMiddleGrey) / middle, double(kBrightest) / double(brightest)));
}

Picture tone_map(std::span<const float> radiance, std::span<const std::uint8_t> shaded, std::uint32_t width,
                 std::uint32_t height, float exposure) {
    if (exposure == 0.0f) exposure = auto_exposure(radiance, shaded);
    Picture picture{width, height, std::vector<std::uint8_t>(std::size_t(width) * height * 3)};
    for (std::uint32_t y = 0; y < height; ++y) {
        const Color background = sky(y, height);
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t pixel = std::size_t(y) * width + x;
            std::uint8_t* target = &picture.rgb[3 * pixel];
            if (shaded[pixel] != 0)
                write_pixel(target, &radiance[3 * pixel], exposure);
            else
                for (std::size_t c = 0; c < 3; ++c) target[c] = encode_srgb(background[c]);
        }
    }
    return picture;
}

} // namespace manylights::lab
