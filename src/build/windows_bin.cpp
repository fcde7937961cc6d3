#include "src/build/windows.h"

#include "src/format/layout.h"

#include <algorithm>
#include <bit>

namespace manylights::detail {

namespace {

// One light along one axis of the image.
struct AxisSpan {
    const TileWedge* wedges; // of the whole image
    std::uint32_t tile_px;
    std::uint32_t first_px, last_px;
    double offset, depth, radius;

    std::uint32_t first_tile() const { return first_px / tile_px; }
    std::uint32_t last_tile() const { return last_px / tile_px; }

    TileCut cut(std::uint32_t tile) const {
        const std::uint32_t origin = tile * tile_px;
        const std::uint32_t begin = std::max(first_px, origin) - origin;
        const std::uint32_t end = std::min(last_px - origin, tile_px - 1);
        const std::uint32_t steps = ml_tile_step(begin, tile_px) | (ml_tile_step(end, tile_px) << 4);
        return {cut_wedge(wedges[tile], offset, depth, radius), tile, steps};
    }
};

// Collects the records of a view.
class Recorder {
  public:
    Recorder(const Grid& grid, const Camera& camera, float depth_scale, Windows& windows)
        : grid_(grid), camera_(camera), depth_scale_(depth_scale), windows_(windows) {}

    // windows.rows has room for all rows.
    [[nodiscard]] bool add(const VisibleLight& light, const ViewSphere& sphere) {
        const AxisSpan columns = span(0, windows_.wedges.data(), light, sphere);
        const AxisSpan rows = span(1, windows_.wedges.data() + grid_.tiles_x, light, sphere);
        std::uint32_t row_count = 0;
        for (std::uint32_t y = rows.first_tile(); y <= rows.last_tile(); ++y) {
            windows_.rows[row_count] = rows.cut(y);
            if (!windows_.rows[row_count].cut.depths.empty()) ++row_count;
        }
        for (std::uint32_t x = columns.first_tile(); x <= columns.last_tile(); ++x) {
            const TileCut column = columns.cut(x);
            if (column.cut.depths.empty()) continue;
            for (std::uint32_t r = 0; r < row_count; ++r)
                if (!add_tile(light.index, column, windows_.rows[r], sphere.radius)) return false;
        }
        return true;
    }

  private:
    AxisSpan span(int axis, const TileWedge* wedges, const VisibleLight& light, const ViewSphere& sphere) const {
        return {wedges,           grid_.tile_px, light.first_px[axis], light.last_px[axis], sphere.center[axis],
                sphere.center[2], sphere.radius};
    }

    // The range is clipped to the planes between which points are promised anything, and then widened by what a
    // caller's depth may be off.
    bool add_tile(std::uint32_t light, const TileCut& column, const TileCut& row, double radius) {
        const Interval& a = column.cut.depths;
        const Interval& b = row.cut.depths;
        const Interval depths = {std::max({a.low, b.low, camera_.near_depth}),
                                 std::min({a.high, b.high, camera_.far_depth})};
        if (depths.empty() || misses_corner(column.cut, row.cut, radius)) return true;
        const DepthRange range = widened_depths(depths);
        const std::uint32_t near_bits = ml_depth_code(range.low, depth_scale_) | (column.steps << 24);
        const std::uint32_t far_bits = ml_depth_code(range.high, depth_scale_) | (row.steps << 24);
        const std::uint64_t tile =
            grid_.cell_offset + static_cast<std::uint64_t>(row.tile) * grid_.tiles_x + column.tile;
        ++windows_.offsets[tile + 2];
        return windows_.found.push({light, near_bits, far_bits, static_cast<std::uint32_t>(tile)});
    }

    const Grid& grid_;
    const Camera& camera_;
    float depth_scale_;
    Windows& windows_;
};

void add_wedges(const Axis& axis, std::uint32_t tile_px, std::uint32_t count, double guard_px, TileWedge* wedges) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t first = i * tile_px;
        wedges[i] = tile_wedge(axis, first, std::min(first + (tile_px - 1), axis.size - 1), guard_px);
    }
}

// False: out of memory. Stops behind the limit.
bool record_view(const Grid& grid, const View& view, std::uint64_t limit, float depth_scale, Windows& windows) {
    if (!windows.wedges.resize(static_cast<std::size_t>(grid.tiles_x) + grid.tiles_y)) return false;
    if (!windows.rows.resize(grid.tiles_y)) return false;
    const Camera& camera = view.camera;
    add_wedges(camera.axes[0], grid.tile_px, grid.tiles_x, camera.guard_px, windows.wedges.data());
    add_wedges(camera.axes[1], grid.tile_px, grid.tiles_y, camera.guard_px, windows.wedges.data() + grid.tiles_x);
    Recorder recorder(grid, camera, depth_scale, windows);
    for (std::size_t i = 0; i < view.lights.size() && windows.found.size() <= limit; ++i)
        if (!recorder.add(view.lights[i], view.spheres[i])) return false;
    return true;
}

// See fill_bins: afterwards offsets[t] is where tile t begins. A tile's records keep their order.
bool sort_by_tile(std::uint64_t tile_count, Windows& windows) {
    if (!windows.by_tile.resize(windows.found.size())) return false;
    std::uint32_t* offsets = windows.offsets.data();
    for (std::uint64_t tile = 0; tile < tile_count; ++tile) offsets[tile + 2] += offsets[tile + 1];
    for (std::size_t i = 0; i < windows.found.size(); ++i) {
        const WindowRecord& record = windows.found[i];
        windows.by_tile[offsets[record.tile + 1]++] = record;
    }
    return true;
}

} // namespace

void Windows::use(const Allocator& allocator) {
    wedges.use(allocator);
    rows.use(allocator);
    offsets.use(allocator);
    found.use(allocator);
    by_tile.use(allocator);
    tiles.use(allocator);
}

// A histogram of exponents: bin b holds the near ends in [2^(b - 127), 2^(b - 126)), bin 0 also all that are less.
float choose_depth_scale(const VisibleLight* lights, std::uint64_t count) {
    constexpr int kLargestExponent = 126; // of a scale in this format
    std::uint64_t bins[256] = {};
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto bits = std::bit_cast<std::uint32_t>(lights[i].min_depth);
        ++bins[(bits & 0x80000000u) != 0 ? 0 : bits >> 23];
    }
    std::uint64_t beyond = 0; // in the bins behind last
    int last = 255;
    while (last > 0 && beyond + bins[last] <= count / 1024) beyond += bins[last--];
    const int exponent = std::min(18 - (last - 126), kLargestExponent);
    return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
}

bool bin_windows(const Grid* grids, const View* views, std::uint32_t view_count, std::uint64_t limit, Windows& windows,
                 bool& fits) {
    const Grid& last = grids[view_count - 1];
    const std::uint64_t tile_count = last.cell_offset + last.cell_count;
    if (!windows.offsets.resize(tile_count + 2)) return false;
    windows.offsets.fill_zero();
    windows.found.clear();
    for (std::uint32_t v = 0; v < view_count; ++v) {
        windows.views[v].depth_scale = choose_depth_scale(views[v].lights.data(), views[v].lights.size());
        if (!record_view(grids[v], views[v], limit, windows.views[v].depth_scale, windows)) return false;
    }
    fits = windows.found.size() <= limit;
    return !fits || sort_by_tile(tile_count, windows);
}

} // namespace manylights::detail
