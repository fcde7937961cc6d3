#include "src/build/bounds.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace manylights::detail {

namespace {

constexpr double kFloatMax = std::numeric_limits<float>::max();

// The upper end of slope_bounds. The slope of a point on the circle grows up to the point where a line through the
// camera touches it, and has no other maximum. So over the part of the disc behind the near plane the maximum is at
// the tangent point, if that is behind the plane, and else where the circle meets the plane.
//
// With c = (offset, depth), d = |c| and t = sqrt(d^2 - r^2), the tangent point is c turned by asin(r / d) towards
// greater slopes and scaled by cos = t / d (Mara and McGuire, 2D Polyhedral Bounds of a Clipped, Perspective-Projected
// 3D Sphere, JCGT 2013): (offset * t + depth * r, depth * t - offset * r) * t / d^2.
//
// Conservative upwards: near_depth is before the true near plane, and the radius has its slack already.
double greatest_slope(double offset, double depth, double radius, double near_depth) {
    const double squared_distance = offset * offset + depth * depth;
    const double squared_radius = radius * radius;
    if (squared_distance > squared_radius) {
        const double t = std::sqrt(squared_distance - squared_radius);
        const double x = offset * t + depth * radius;
        const double z = depth * t - offset * radius;
        if (z > 0.0 && z * t >= near_depth * squared_distance) return std::min(x / z, kUnbounded);
    }
    if (!(near_depth > 0.0)) return kUnbounded;
    const double height = near_depth - depth;
    const double cut = offset + std::sqrt(std::max(squared_radius - height * height, 0.0));
    return std::min(cut / near_depth, kUnbounded);
}

// The next float below or above; finite in, so the bits are those of a plain number.
float next_below(float x) {
    if (x == 0.0f) return -std::numeric_limits<float>::denorm_min();
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>(x > 0.0f ? bits - 1 : bits + 1);
}

float round_down(double x) {
    if (x > kFloatMax) return std::numeric_limits<float>::max();
    if (x < -kFloatMax) return -std::numeric_limits<float>::infinity();
    const auto nearest = static_cast<float>(x);
    return static_cast<double>(nearest) > x ? next_below(nearest) : nearest;
}

} // namespace

Interval slope_bounds(double offset, double depth, double radius, double near_depth) {
    return {-greatest_slope(-offset, depth, radius, near_depth), greatest_slope(offset, depth, radius, near_depth)};
}

// A pixel p is shaded for points that project within guard_px of its centre p + 0.5. It needs the light if that
// interval, widened by rounding, meets [low, high]: high >= p + 0.5 - reach and low <= p + 0.5 + reach. So both ends
// move outward by reach: conservative. 0.05 pixels are a thousandth of a tile of 48, 1e-5 of the image is far above
// float's precision there.
PixelRange pixel_bounds(const Axis& axis, Interval slopes, double guard_px) {
    const double a = axis.origin + axis.scale * slopes.low;
    const double b = axis.origin + axis.scale * slopes.high;
    const double reach = guard_reach(axis, guard_px);
    const double last_pixel = axis.size - 1.0;
    const double first = std::max(std::ceil(std::min(a, b) - 0.5 - reach), 0.0);
    const double last = std::min(std::floor(std::max(a, b) - 0.5 + reach), last_pixel);
    // Compared before they are converted: outside of the image they may not fit an integer.
    if (!(first <= last && first <= last_pixel && last >= 0.0)) return {0, 0, true};
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last), false};
}

DepthRange widened_depths(Interval depths) {
    constexpr double kRelative = 0x1p-20;
    return {round_down(depths.low - std::fabs(depths.low) * kRelative),
            -round_down(-(depths.high + std::fabs(depths.high) * kRelative))};
}

DepthRange depth_bounds(double depth, double radius) { return widened_depths({depth - radius, depth + radius}); }

} // namespace manylights::detail
