// What a sphere covers of the image and of a tile's depths: one text for C++ (tests) and GLSL (techniques that build on
// the device). Single precision; every result is a superset, by the slack whose derivation stands beside the formula.
//
// A sphere is given by its centre in the camera's axes (offsets to the right and down, depth in front) and its culling
// radius. A slope is an offset divided by a depth: a point's place along an axis of the image, in pixels, is
// size / 2 + pixels_per_slope * slope.
#ifndef MANYLIGHTS_LAB_SPHERE_BOUNDS_H
#define MANYLIGHTS_LAB_SPHERE_BOUNDS_H

#include <manylights/format.h>

#if defined(__cplusplus)
#include <algorithm>
#include <cmath>
namespace manylights::lab {
using std::abs;
using std::ceil;
using std::floor;
using std::max;
using std::min;
using std::sqrt;
#endif

// Slopes beyond are outside of every image.
const float kSteepest = 1e6f;
// No depth of a scene is as far.
const float kFarthest = 3e38f;

// The radius that culling uses instead of the range; distance: of the light from the camera. The rule lets a point pass
// up to 3e-7 * (range + distance) beyond the range, for positions and squares are rounded, and turning the centre into
// the camera's axes in floats moves it by less than 4 * 2^-24 of the distance. 1e-20 stands for squares that underflow.
ML_FN float culling_radius(float range, float distance) { return range + 1e-6f * (range + distance) + 1e-20f; }

// No point of a disc in front of the camera has a greater slope; (offset, depth) is its centre, in the plane of an
// image axis. With d the centre's distance from the camera and t = sqrt(d^2 - r^2), the line from the camera that
// touches the disc on the side of greater slopes has the slope (offset t + depth r) / (depth t - offset r) (Mara and
// McGuire, 2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere, JCGT 2013). Where it touches behind the
// camera, or the camera is inside the disc, slopes are unbounded.
//
// Slack: t^2 is off by less than 2^-21 d^2, so t by less than s = d min(2^-20 d / t, 2^-10), and numerator and
// denominator by less than d s + 2^-21 d^2, of which e is four times as much.
ML_FN float greatest_slope(float offset, float depth, float radius) {
    float d = sqrt(offset * offset + depth * depth);
    if (!(d > radius)) return kSteepest;
    float t = sqrt((d - radius) * (d + radius));
    float e = 4.0f * d * d * min(2e-6f * d / max(t, 1e-30f), 2e-3f);
    float numerator = offset * t + depth * radius + e;
    float denominator = depth * t - offset * radius;
    denominator += numerator > 0.0f ? -e : e;
    if (!(denominator > 0.0f)) return kSteepest;
    return min(numerator / denominator, kSteepest);
}

// Pixels along an axis. Empty: first is above last.
struct PixelSpan {
    MlUint first, last;
};

// The pixels whose points may lie in the disc. reach: how far from a pixel's centre points are looked for.
ML_FN PixelSpan pixel_span(float offset, float depth, float radius, float pixels_per_slope, float size, float reach) {
    float low = -greatest_slope(-offset, depth, radius);
    float high = greatest_slope(offset, depth, radius);
    float first = max(ceil(0.5f * size + pixels_per_slope * low - 0.5f - reach), 0.0f);
    float last = min(floor(0.5f * size + pixels_per_slope * high - 0.5f + reach), size - 1.0f);
    PixelSpan span;
    bool is_empty = !(first <= last); // compared before they are converted
    span.first = is_empty ? 1u : MlUint(first);
    span.last = is_empty ? 0u : MlUint(last);
    return span;
}

// Depths. Empty: low is above high.
struct DepthSpan {
    float low, high;
};

ML_FN DepthSpan meet(DepthSpan a, DepthSpan b) {
    DepthSpan both;
    both.low = max(a.low, b.low);
    both.high = min(a.high, b.high);
    return both;
}

// The depths of the sphere inside the half-space of slopes above (side 1) or below (side -1) the given one, whose plane
// goes through the camera and has the unit normal n inwards. With h the distance of the sphere's centre from it:
// nothing where h <= -r; a pole (the centre moved by r along the depth) where it is inside; else an extreme of the disc
// that the plane cuts, whose centre is c - h n and whose radius is sqrt(r^2 - h^2), along which depth changes by
// |n_offset| per unit.
//
// Slack: slope, normal and distance are off by less than 2^-21 (|c| + r) together; h is moved inwards by four times
// that, the result outwards likewise.
ML_FN DepthSpan half_space_depths(float slope, float side, float offset, float depth, float radius) {
    float slack = 2e-6f * (abs(offset) + abs(depth) + radius);
    float n_offset = side / sqrt(1.0f + slope * slope);
    float n_depth = -slope * n_offset;
    float h = n_offset * offset + n_depth * depth + slack;
    DepthSpan span;
    span.low = kFarthest;
    span.high = -kFarthest;
    if (h <= -radius) return span;
    float disc_depth = depth - h * n_depth;
    float disc_reach = sqrt(max((radius - h) * (radius + h), 0.0f)) * abs(n_offset);
    span.low = (h - radius * n_depth >= 0.0f ? depth - radius : disc_depth - disc_reach) - slack;
    span.high = (h + radius * n_depth >= 0.0f ? depth + radius : disc_depth + disc_reach) + slack;
    return span;
}

// The depths of the sphere between two slopes of an axis.
ML_FN DepthSpan wedge_depths(float low_slope, float high_slope, float offset, float depth, float radius) {
    return meet(half_space_depths(low_slope, 1.0f, offset, depth, radius),
                half_space_depths(high_slope, -1.0f, offset, depth, radius));
}

// A half-space whose plane goes through the camera and is upright on an axis of the image: the slopes along the axis
// that are above (side 1) or below (side -1) one.
struct SlopeBound {
    float slope, side;
};

// Whether the sphere misses all that two such half-spaces, of either axis, have in common, because it is beside the ray
// in which their planes meet: it may meet both of them and still do so. Let n, m be their normals inwards, h, k the
// distances of the centre c from the planes, and q the point of the ray's line next to c; then c - q = -(a n + b m)
// with a = (g k - h) / (1 - g^2), b = (g h - k) / (1 - g^2), g = n.m, and no point in common is nearer than q where a
// and b are above 0. False where another point is the next one.
//
// Slack: h and k are moved inwards as in half_space_depths, which moves the planes and leaves g as it is; 1e-5 of the
// distance is ten times what the rest is off by, unless the planes are all but parallel.
ML_FN bool misses_edge(SlopeBound across, SlopeBound down, float right, float below, float depth, float radius) {
    float slack = 2e-6f * (abs(right) + abs(below) + abs(depth) + radius);
    float n = across.side / sqrt(1.0f + across.slope * across.slope);
    float m = down.side / sqrt(1.0f + down.slope * down.slope);
    float h = n * (right - across.slope * depth) + slack;
    float k = m * (below - down.slope * depth) + slack;
    float g = n * across.slope * m * down.slope;
    if (!(h < g * k && k < g * h) || g * g > 0.9f) return false;
    float distance = sqrt(max((h * h + k * k - 2.0f * g * h * k) / (1.0f - g * g), 0.0f));
    return distance * (1.0f - 1e-5f) >= radius;
}

// The slope at the outer edge of what a pixel's points may lie in: side -1 before it, 1 behind it.
ML_FN float pixel_edge_slope(MlUint pixel, float side, float pixels_per_slope, float size, float reach) {
    return (float(pixel) + 0.5f + side * reach - 0.5f * size) / pixels_per_slope;
}

#if defined(__cplusplus)
} // namespace manylights::lab
#endif

#endif
