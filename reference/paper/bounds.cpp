#include "reference/paper/bounds.h"

#include <algorithm>
#include <cmath>

namespace manylights::paper {
namespace {

// The promise allows the query's depth 2^-20 relative; a quarter more covers the rounding of the range's ends.
constexpr float kDepthSlack = 1.25f * 0x1p-20f;

template <class Real>
struct Slopes {
    Real min, max; ///< of side / depth over the visible part of the sphere
};

// Two dimensions: the circle at (side, depth) seen from the origin, which lies outside. Its tangent points are the
// centre turned by +-asin(r / |c|) and scaled; as t = sqrt(|c|^2 - r^2) the slopes are
//     (side t -+ depth r) / (depth t +- side r)
// Each pair (numerator, denominator) has length |c|^2, so no slope that matters is a quotient of two cancelled numbers.
template <class Real>
Slopes<Real> tangent_slopes(Real side, Real depth, Real radius, Real t) {
    return {(side * t - depth * radius) / (depth * t + side * radius),
            (side * t + depth * radius) / (depth * t - side * radius)};
}

// The same where the near plane cuts the circle, or the origin is inside: a tangent point in front of the near plane
// gives way to the end of the cut, whose half length is `cut`. Conservative: the circle's projection holds the
// sphere's.
Slopes<double> clipped_slopes(double side, double depth, double radius, double near_depth) {
    const double to_plane = near_depth - depth;
    const double cut = std::sqrt(std::max(radius * radius - to_plane * to_plane, 0.0));
    Slopes<double> slopes{(side - cut) / near_depth, (side + cut) / near_depth};
    const double length_squared = side * side + depth * depth;
    const double t_squared = length_squared - radius * radius;
    if (!(t_squared > 0.0)) return slopes;
    const double t = std::sqrt(t_squared);
    const Slopes<double> tangents = tangent_slopes(side, depth, radius, t);
    const double scale = t / length_squared; // the tangent points' depths are the denominators times this
    if ((depth * t + side * radius) * scale >= near_depth) slopes.min = tangents.min;
    if ((depth * t - side * radius) * scale >= near_depth) slopes.max = tangents.max;
    return slopes;
}

struct Span {
    std::int32_t first, last; ///< tiles; empty where last < first
};

// Clamped as numbers of type Real, since converting a large one to an integer is undefined; floor of the last one by
// way of a number that is not negative.
template <class Real>
Span tile_span(Slopes<Real> slopes, const TileAxis& axis) {
    const Real first = slopes.min * Real(axis.scale) + Real(axis.first_center);
    const Real last = slopes.max * Real(axis.scale) + Real(axis.last_center) + Real(1);
    const Real end = Real(axis.tiles);
    return {std::int32_t(std::min(std::max(first, Real(0)), end)),
            std::int32_t(std::min(std::max(last, Real(0)), end)) - 1};
}

template <class Real>
bool store(const Grid& grid, const SliceTable& slices, const CulledLight& light, Slopes<Real> slopes_x,
           Slopes<Real> slopes_y, BoundedLight& bounded) {
    const Span x = tile_span(slopes_x, grid.x), y = tile_span(slopes_y, grid.y);
    const float lower = light.depth - light.radius, upper = light.depth + light.radius;
    bounded.min_depth = lower - kDepthSlack * std::abs(lower);
    bounded.max_depth = upper + kDepthSlack * std::abs(upper);
    const std::uint32_t first_slice = slices.slice_of(bounded.min_depth);
    bounded.slices = slices.slice_of(bounded.max_depth) - first_slice + 1;
    bounded.first_cell = (first_slice * grid.y.tiles + std::uint32_t(y.first)) * grid.x.tiles + std::uint32_t(x.first);
    bounded.columns = std::uint16_t(x.last - x.first + 1);
    bounded.rows = std::uint16_t(y.last - y.first + 1);
    bounded.index = light.index;
    return (x.first <= x.last) & (y.first <= y.last);
}

// Pixel p needs the light where [p + 0.5 - guard - e, p + 0.5 + guard + e] meets the light's interval, e the widening.
// So the first pixel is the smallest p >= min - 0.5 - guard - e, and the first tile floor((min + 0.5 - guard - e) / T):
// the same but for intervals that only touch, which e covers. The last tile is floor((max - 0.5 + guard + e) / T).
TileAxis tile_axis(float scale, float center, float reach, std::uint32_t size, std::uint32_t tile_px) {
    const double per_px = 1.0 / tile_px;
    return {float(scale * per_px), float((double(center) - reach) * per_px), float((double(center) + reach) * per_px),
            (size + tile_px - 1) / tile_px};
}

} // namespace

// 1e-3 of a tile for rounding at a tile's edge, and 2^-20 of the image for rounding of pixel positions.
Grid make_grid(const Camera& camera, std::uint32_t tile_px) {
    const float widening = 1e-3f * float(tile_px) + 0x1p-20f * float(std::max(camera.width, camera.height));
    const float reach = camera.guard_px - 0.5f + widening;
    return {tile_px, widening, tile_axis(camera.scale_x, camera.center_x, reach, camera.width, tile_px),
            tile_axis(camera.scale_y, camera.center_y, reach, camera.height, tile_px)};
}

bool bound(const Camera& camera, const Grid& grid, const SliceTable& slices, const CulledLight& light,
           BoundedLight& bounded) {
    const float nearest = light.depth - light.radius;
    // Behind the near plane as a whole, and not so large against its distance from the camera plane that the directions
    // of its tangents need more than a float's digits.
    if (nearest >= camera.near_depth &&
        nearest * 16384.0f >= std::abs(light.x) + std::abs(light.y) + light.depth + light.radius) {
        const float across = nearest * (light.depth + light.radius); // depth^2 - r^2
        const float t_x = std::sqrt(light.x * light.x + across), t_y = std::sqrt(light.y * light.y + across);
        return store(grid, slices, light, tangent_slopes(light.x, light.depth, light.radius, t_x),
                     tangent_slopes(light.y, light.depth, light.radius, t_y), bounded);
    }
    return store(grid, slices, light, clipped_slopes(light.x, light.depth, light.radius, camera.near_depth),
                 clipped_slopes(light.y, light.depth, light.radius, camera.near_depth), bounded);
}

} // namespace manylights::paper
