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

// How far a pixel's claim reaches from its centre: the guard, and 0.05 pixels and 1e-5 of the image for an edge that
// the shader's pixel and this one compute differently.
inline double guard_reach(const Axis& axis, double guard_px) { return guard_px + 0.05 + 1e-5 * axis.size; }

// Pixel bounds in floats (cull_lanes.cpp), u = 2^-24: a slope within the image is off by 32u relative at most, its
// scale and its origin by u. With |origin| <= 4 sizes the pixels of the image have |scale * slope| <= 5 sizes.
// Position, and the subtraction of the centre and the reach: less than (1 + 1) * 5 + 4 + 6 * 2 = 26u of a size, and
// 1e-5 are 160u. The slope's own 32u are added to it before.
inline bool floats_suffice(const Axis& axis) {
    return axis.origin <= 4.0 * axis.size && axis.origin >= -4.0 * axis.size;
}
inline double float_bounds_slack(const Axis& axis) { return 1e-5 * axis.size; }

// Depths, widened by the 2^-20 that a caller's depth may be off, and rounded outward.
struct DepthRange {
    float low, high;
};
DepthRange widened_depths(Interval depths);
// Of [depth - radius, depth + radius].
DepthRange depth_bounds(double depth, double radius);

} // namespace manylights::detail
