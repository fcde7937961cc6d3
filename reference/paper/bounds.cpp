#include "reference/paper/bounds.h"

#include <algorithm>
#include <cmath>

namespace manylights::paper {
namespace {

// side / depth at the borders of a rectangle: left, top, right, bottom. Arrays of four, which compilers turn into
// vectors.
struct Slopes {
    float at[4];
};

// Two dimensions: the circle at (side, depth) seen from the origin, which lies outside. Its tangent points are the
// centre turned by +-asin(r / |c|) and scaled; as t = sqrt(|c|^2 - r^2) the slopes are
//     (side t -+ depth r) / (depth t +- side r)
// Each pair (numerator, denominator) has length |c|^2, so no slope that matters is a quotient of two cancelled numbers.
Slopes tangent_slopes(const CulledLight& light) {
    const float x = light.x, y = light.y, depth = light.depth, radius = light.radius;
    const float across = (depth - radius) * (depth + radius);
    const float t_x = std::sqrt(x * x + across), t_y = std::sqrt(y * y + across);
    const float side[4] = {x, y, x, y}, t[4] = {t_x, t_y, t_x, t_y}, turn[4] = {-radius, -radius, radius, radius};
    Slopes slopes;
    for (int i = 0; i < 4; ++i) slopes.at[i] = (side[i] * t[i] + depth * turn[i]) / (depth * t[i] - side[i] * turn[i]);
    return slopes;
}

// The same where the near plane cuts the circle, or the origin is inside: a tangent point in front of the near plane
// gives way to the end of the cut, whose half length is `cut`. Conservative: the circle's projection holds the
// sphere's.
double clipped_slope(double side, double depth, double radius, double turn, double near_depth) {
    const double to_plane = near_depth - depth;
    const double cut = std::sqrt(std::max(radius * radius - to_plane * to_plane, 0.0));
    const double at_plane = (side + std::copysign(cut, turn)) / near_depth;
    const double length_squared = side * side + depth * depth;
    const double t_squared = length_squared - radius * radius;
    if (!(t_squared > 0.0)) return at_plane;
    const double t = std::sqrt(t_squared);
    const double denominator = depth * t - side * turn; // times t / |c|^2: the tangent point's depth
    return denominator * t / length_squared >= near_depth ? (side * t + depth * turn) / denominator : at_plane;
}

Slopes clipped_slopes(const CulledLight& light, float near_depth) {
    Slopes slopes;
    for (int i = 0; i < 4; ++i) {
        const float side = i % 2 == 0 ? light.x : light.y, turn = i < 2 ? -light.radius : light.radius;
        slopes.at[i] = float(clipped_slope(side, light.depth, light.radius, turn, near_depth));
    }
    return slopes;
}

// Pixel p needs the light where [p + 0.5 - guard - e, p + 0.5 + guard + e] meets the light's interval, e the widening.
// So the first pixel is the smallest p >= min - 0.5 - guard - e, and the first tile floor((min + 0.5 - guard - e) / T):
// the same but for intervals that only touch, which e covers. The last tile is floor((max - 0.5 + guard + e) / T).
void set_axis(Grid& grid, int axis, float scale, float center, float reach, std::uint32_t tiles) {
    for (int side : {axis, axis + 2}) {
        const double position = side < 2 ? double(center) - reach : double(center) + reach + grid.tile_px;
        grid.scale[side] = float(double(scale) / grid.tile_px);
        grid.offset[side] = float(position / grid.tile_px);
        grid.end[side] = float(tiles);
    }
}

} // namespace

// e = 1e-3 of a tile for rounding at a tile's edge, and 2^-20 of the image for rounding of pixel positions.
Grid make_grid(const Camera& camera, std::uint32_t tile_px) {
    Grid grid{};
    grid.tile_px = tile_px;
    grid.tiles_x = (camera.width + tile_px - 1) / tile_px;
    grid.tiles_y = (camera.height + tile_px - 1) / tile_px;
    grid.widening_px = 1e-3f * float(tile_px) + 0x1p-20f * float(std::max(camera.width, camera.height));
    const float reach = camera.guard_px - 0.5f + grid.widening_px;
    set_axis(grid, 0, camera.scale_x, camera.center_x, reach, grid.tiles_x);
    set_axis(grid, 1, camera.scale_y, camera.center_y, reach, grid.tiles_y);
    return grid;
}

bool bound(const Camera& camera, const Grid& grid, const SliceTable& slices, const CulledLight& light, CellBox& box,
           CellLight& cell_light) {
    const float lower = light.depth - light.radius, upper = light.depth + light.radius;
    // Behind the near plane as a whole, and not so large against its distance from the camera plane that the directions
    // of its tangents need more than a float's digits.
    const bool plain = lower >= camera.near_depth && lower * 16384.0f >= std::abs(light.x) + std::abs(light.y) + upper;
    const Slopes slopes = plain ? tangent_slopes(light) : clipped_slopes(light, camera.near_depth);
    // Clamped as floats, since converting a large one to an integer is undefined; no number is negative then, and
    // conversion rounds down.
    std::int32_t sides[4];
    for (int i = 0; i < 4; ++i) {
        const float position = slopes.at[i] * grid.scale[i] + grid.offset[i];
        sides[i] = std::int32_t(std::min(std::max(position, 0.0f), grid.end[i]));
    }
    const std::uint32_t left = std::uint32_t(sides[0]), top = std::uint32_t(sides[1]);

    cell_light = {lower - kDepthSlack * std::abs(lower), upper + kDepthSlack * std::abs(upper), light.index};
    const std::uint32_t first_slice = slices.slice_of(cell_light.min_depth);
    box.slices = slices.slice_of(cell_light.max_depth) - first_slice + 1;
    box.first_cell = (first_slice * grid.tiles_y + top) * grid.tiles_x + left;
    box.columns = std::uint16_t(sides[2] - sides[0]);
    box.rows = std::uint16_t(sides[3] - sides[1]);
    return (sides[0] < sides[2]) & (sides[1] < sides[3]);
}

} // namespace manylights::paper
