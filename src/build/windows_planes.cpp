// The planes between the tiles of a view.
#include "src/build/narrow.h"
#include "src/build/record_stages.h"

#include <algorithm>
#include <limits>

namespace manylights::detail {

namespace {

// The planes of all columns or rows. Behind the last one are planes that cut nothing.
const AxisPlanes* make_planes(const Axis& axis, std::uint32_t tile_px, std::uint32_t count, double guard_px,
                              AxisPlanes* planes) {
    const std::size_t room = count + kLanePadding;
    const int before = axis.scale > 0.0 ? 0 : 1; // the side of the lesser pixels
    for (std::uint32_t i = 0; i < room; ++i) {
        const std::uint32_t first = i < count ? i * tile_px : 0;
        const TileWedge wedge = tile_wedge(axis, first, std::min(first + (tile_px - 1), axis.size - 1), guard_px);
        const auto& sides = wedge.sides;
        planes[i] = {static_cast<float>(sides[before].offset), static_cast<float>(sides[before].depth),
                     static_cast<float>(sides[1 - before].offset), static_cast<float>(sides[1 - before].depth)};
    }
    return planes;
}

// A little outside of both planes: what a caller's depth may be off, and float's rounding.
float widened_near(double depth) { return static_cast<float>(depth * (1.0 - 0x1p-19)); }
float widened_far(double depth) {
    constexpr double kMost = std::numeric_limits<float>::max();
    return depth * (1.0 + 0x1p-19) < kMost ? static_cast<float>(depth * (1.0 + 0x1p-19))
                                           : std::numeric_limits<float>::infinity();
}

std::size_t plane_room(const Grid& grid) { return std::size_t{grid.tiles_x} + grid.tiles_y + 2 * kLanePadding; }

} // namespace

bool make_narrow_views(ManylightsBuilder& builder, NarrowView (&views)[kMaxViews]) {
    std::size_t room = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) room += plane_room(builder.grids[v]);
    if (!builder.records.planes.resize(room)) return false;
    AxisPlanes* at = builder.records.planes.data();
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        const Camera& camera = builder.views[v].camera;
        NarrowView& view = views[v];
        view.columns = make_planes(camera.axes[0], grid.tile_px, grid.tiles_x, camera.guard_px, at);
        view.rows =
            make_planes(camera.axes[1], grid.tile_px, grid.tiles_y, camera.guard_px, at + grid.tiles_x + kLanePadding);
        view.near_depth = widened_near(camera.near_depth);
        view.far_depth = widened_far(camera.far_depth);
        view.depth_scale = builder.windows.views[v].depth_scale;
        view.tiles_x = grid.tiles_x;
        view.first_tile = static_cast<std::uint32_t>(grid.tile_offset);
        view.full_steps = ml_tile_step(grid.tile_px - 1, grid.tile_px);
        at += plane_room(grid);
    }
    return true;
}

} // namespace manylights::detail
