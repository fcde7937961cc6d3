#include "tests/property/edge_points.h"

#include <cmath>

namespace manylights::test {

namespace {

double ulp(double value) {
    float f = static_cast<float>(std::fabs(value));
    return static_cast<double>(std::nextafter(f, INFINITY)) - f;
}

/// A pixel's centre, moved by what the guard allows.
double position_near_pixel(oracle::Random& random, std::uint32_t size, double guard) {
    return random.below(size) + 0.5 + random.between(-guard, guard);
}

double random_depth(oracle::Random& random, const oracle::Camera& camera) {
    // About the far plane, where float clip z decides what is drawn.
    if (camera.far_depth < INFINITY && random.chance(0.05))
        return camera.far_depth * (1.0 + random.sign() * random.octaves(-24, -6));
    for (;;) {
        double depth = camera.near_depth * (1.0 + 1e-4) * random.octaves(0, 16);
        if (depth <= camera.far_depth) return depth;
    }
}

/// A position that a pixel on one side of a tile's edge is only just promised; the middle of the image if it has one
/// tile.
double tile_edge_position(oracle::Random& random, std::uint32_t size, std::uint32_t tile_px, double guard) {
    std::uint32_t tiles = (size + tile_px - 1) / tile_px;
    if (tiles < 2) return size * 0.5;
    double edge = static_cast<double>(tile_px) * (1 + random.below(tiles - 1));
    double position = random.chance(0.5) ? edge + (0.5 - guard) : edge - (0.5 - guard);
    return position + random.integer(-4, 4) * ulp(position);
}

bool is_at_tile_edge(double position, std::uint32_t size, std::uint32_t tile_px, double guard) {
    for (double offset : {0.5 - guard, guard - 0.5}) {
        double edge = std::round((position - offset) / tile_px) * tile_px;
        bool inner = edge > 0.0 && edge < size;
        if (inner && std::fabs(position - (edge + offset)) <= 4.0 * ulp(edge + offset)) return true;
    }
    return false;
}

} // namespace

Grid grid_of(const ManylightsSettings& settings, const ManylightsView& view) {
    ManylightsSettings lists = settings;
    lists.structure = MANYLIGHTS_STRUCTURE_LISTS;
    Frame frame(lists);
    Grid grid{};
    if (!frame.build({view}, lights_of({}))) return grid;
    grid.tile_px = frame.view().tile_px;
    for (std::uint32_t i = 1; i < frame.view().slice_count; ++i)
        grid.slice_edges.push_back(frame.buffers().slice_edges[frame.view().slice_offset + i]);
    return grid;
}

EdgePoint point_anywhere(oracle::Random& random, const oracle::Camera& camera) {
    double guard = camera.view.guard_px;
    double x = position_near_pixel(random, camera.view.width, guard);
    double y = position_near_pixel(random, camera.view.height, guard);
    return {unproject(camera, {x, y, random_depth(random, camera)}), {}};
}

EdgePoint point_at_tile_edge(oracle::Random& random, const oracle::Camera& camera, const Grid& grid) {
    const ManylightsView& view = camera.view;
    double guard = view.guard_px;
    double depth = random_depth(random, camera);
    if (random.chance(0.5)) {
        double x = tile_edge_position(random, view.width, grid.tile_px, guard);
        return {unproject_precisely_along_x(camera, {x, position_near_pixel(random, view.height, guard), depth}), {}};
    }
    double y = tile_edge_position(random, view.height, grid.tile_px, guard);
    return {unproject_precisely_along_y(camera, {position_near_pixel(random, view.width, guard), y, depth}), {}};
}

EdgePoint point_at_slice_edge(oracle::Random& random, const oracle::Camera& camera, const Grid& grid) {
    if (grid.slice_edges.empty()) return point_anywhere(random, camera);
    float edge = grid.slice_edges[random.below(static_cast<std::uint32_t>(grid.slice_edges.size()))];
    double step = ulp(edge);
    EdgePoint result = point_anywhere(random, camera);
    oracle::ScreenPosition screen = project(camera, result.point);
    screen.depth = edge + random.integer(-4, 4) * step;
    result.point = unproject(camera, screen);
    for (int i = -4; i <= 4; ++i) result.query_depths.push_back(static_cast<float>(edge + i * step));
    return result;
}

bool is_at_edge(const oracle::Camera& camera, const Grid& grid, MlFloat3 point) {
    oracle::ScreenPosition screen = project(camera, point);
    double guard = camera.view.guard_px;
    if (is_at_tile_edge(screen.x, camera.view.width, grid.tile_px, guard)) return true;
    if (is_at_tile_edge(screen.y, camera.view.height, grid.tile_px, guard)) return true;
    for (float edge : grid.slice_edges)
        if (std::fabs(screen.depth - edge) <= 4.0 * ulp(edge)) return true;
    return false;
}

} // namespace manylights::test
