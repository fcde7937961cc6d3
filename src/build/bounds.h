#pragma once
// Where a sphere can be seen: which pixels along an axis of the image, which depths, which slices.

#include "src/build/camera.h"
#include "src/build/slices.h"

#include <cstdint>

namespace manylights::detail {

struct Interval {
    double low, high;

    bool empty() const { return !(low <= high); }
};

// offset / depth over the disc of the given centre (offset, depth) and radius, where depth >= near_depth; unbounded
// ends are +-kUnbounded. The disc reaches near_depth, radius > 0.
constexpr double kUnbounded = 1e60;
Interval slope_bounds(double offset, double depth, double radius, double near_depth);

// The pixels that need a light which covers these slopes; empty where it is out of the image.
struct PixelRange {
    std::uint32_t first, last;
    bool empty;
};
PixelRange pixel_bounds(const Axis& axis, Interval slopes, double guard_px);

// Depths, widened by the 2^-20 that a caller's depth may be off, and rounded outward.
struct DepthRange {
    float low, high;
};
DepthRange widened_depths(Interval depths);
// Of [depth - radius, depth + radius].
DepthRange depth_bounds(double depth, double radius);

} // namespace manylights::detail
