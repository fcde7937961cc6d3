// Lights to tiles: buckets, and their records.
#include "src/build/builder.h"
#include "src/build/narrow.h"
#include "src/build/windows_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace manylights::detail {

namespace {

std::uint64_t corner_count(const Grid& grid) { return std::uint64_t{grid.tiles_x + 1} * (grid.tiles_y + 1); }

std::uint64_t all_corners(const ManylightsBuilder& builder) {
    std::uint64_t sum = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) sum += corner_count(builder.grids[v]);
    return sum;
}

// Enough lights for each to pay for its own counts of all tiles.
std::uint32_t light_task_count(const ManylightsBuilder& builder, std::uint64_t tile_count) {
    const std::uint64_t blocks = builder.views[0].lights.block_count();
    const std::uint32_t tasks = task_count_for(builder.settings, blocks, 1);
    const std::uint64_t affordable = 4 * visible_lights(builder) / tile_count;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(affordable, 1, tasks));
}

// The spans of the task's blocks, in all views.
std::uint64_t span_task(ManylightsBuilder& builder, std::uint32_t task) {
    Windows& windows = builder.windows;
    std::uint32_t* corners = windows.corners.data() + task * all_corners(builder);
    SpanCounts counts{};
    std::uint64_t spanned = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        ViewLights& lights = builder.views[v].lights;
        std::memset(corners, 0, corner_count(grid) * sizeof(std::uint32_t));
        counts = {corners, {}, 0};
        const SpanView view = {grid.tile_px, grid.tiles_x, grid.width - 1, grid.height - 1};
        const Part part = part_of(lights.block_count(), task, windows.light_tasks);
        for (std::uint64_t b = part.begin; b < part.end; ++b)
            span_block(view, lights.block(b), windows.spans[v].block(b), counts);
        spanned += counts.tiles;
        std::copy_n(counts.exponents, 256, windows.exponents.data() + 256 * (task * kMaxViews + v));
        corners += corner_count(grid);
    }
    return spanned;
}

// Sums over rows, then over columns: afterwards each corner holds how many lights span the tile below and right of it.
void sum_corners(const Grid& grid, std::uint32_t* corners) {
    const std::uint64_t pitch = grid.tiles_x + 1;
    for (std::uint64_t y = 0; y < grid.tiles_y; ++y) {
        std::uint32_t* row = corners + y * pitch;
        for (std::uint32_t x = 1; x < grid.tiles_x; ++x) row[x] += row[x - 1];
        if (y > 0)
            for (std::uint32_t x = 0; x < grid.tiles_x; ++x) row[x] += row[x - pitch];
    }
}

void choose_scales(ManylightsBuilder& builder) {
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        std::uint32_t sums[256] = {};
        for (std::uint32_t task = 0; task < builder.windows.light_tasks; ++task)
            for (std::uint32_t b = 0; b < 256; ++b)
                sums[b] += builder.windows.exponents[256 * (task * kMaxViews + v) + b];
        builder.windows.views[v].depth_scale = choose_depth_scale(sums);
    }
}

// One bucket per tile and task, the buckets of a tile in the order of the tasks.
void place_buckets(ManylightsBuilder& builder, std::uint64_t tile_count) {
    Windows& windows = builder.windows;
    const std::uint32_t tasks = windows.light_tasks;
    const std::uint64_t corners_per_task = all_corners(builder);
    std::uint32_t sum = 0;
    std::uint64_t corner = 0;
    windows.largest_tile = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        for (std::uint64_t t = 0; t < grid.cell_count; ++t) {
            const std::uint64_t tile = grid.cell_offset + t;
            const std::uint64_t at = corner + t / grid.tiles_x * (grid.tiles_x + 1) + t % grid.tiles_x;
            const std::uint32_t begin = sum;
            for (std::uint32_t task = 0; task < tasks; ++task) {
                windows.begins[tile * tasks + task] = sum;
                windows.cursors[task * tile_count + tile] = sum;
                sum += windows.corners[task * corners_per_task + at];
            }
            windows.largest_tile = std::max(windows.largest_tile, sum - begin);
        }
        corner += corner_count(grid);
    }
    windows.begins[tile_count * tasks] = sum;
}

// The planes of all columns or rows; see AxisPlanes. Behind the last one are planes that cut nothing.
AxisPlanes make_planes(const Axis& axis, std::uint32_t tile_px, std::uint32_t count, double guard_px, float* at) {
    const std::size_t room = count + kLanePadding;
    const AxisPlanes planes = {at, at + room, at + 2 * room, at + 3 * room};
    const int before = axis.scale > 0.0 ? 0 : 1; // the side of the lesser pixels
    for (std::uint32_t i = 0; i < room; ++i) {
        const std::uint32_t first = i < count ? i * tile_px : 0;
        const TileWedge wedge = tile_wedge(axis, first, std::min(first + (tile_px - 1), axis.size - 1), guard_px);
        planes.before_offset[i] = static_cast<float>(wedge.sides[before].offset);
        planes.before_depth[i] = static_cast<float>(wedge.sides[before].depth);
        planes.behind_offset[i] = static_cast<float>(wedge.sides[1 - before].offset);
        planes.behind_depth[i] = static_cast<float>(wedge.sides[1 - before].depth);
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

std::size_t plane_room(const Grid& grid) { return 4 * std::size_t{grid.tiles_x + grid.tiles_y + 2 * kLanePadding}; }

bool make_narrow_views(ManylightsBuilder& builder, NarrowView (&views)[kMaxViews]) {
    std::size_t room = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) room += plane_room(builder.grids[v]);
    if (!builder.windows.planes.resize(room)) return false;
    float* at = builder.windows.planes.data();
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        const Camera& camera = builder.views[v].camera;
        NarrowView& view = views[v];
        view.columns = make_planes(camera.axes[0], grid.tile_px, grid.tiles_x, camera.guard_px, at);
        view.rows = make_planes(camera.axes[1], grid.tile_px, grid.tiles_y, camera.guard_px,
                                at + 4 * std::size_t{grid.tiles_x + kLanePadding});
        view.near_depth = widened_near(camera.near_depth);
        view.far_depth = widened_far(camera.far_depth);
        view.depth_scale = builder.windows.views[v].depth_scale;
        view.tiles_x = grid.tiles_x;
        view.first_tile = static_cast<std::uint32_t>(grid.cell_offset);
        view.full_steps = ml_tile_step(grid.tile_px - 1, grid.tile_px);
        at += plane_room(grid);
    }
    return true;
}

constexpr std::size_t kBufferRoom = kBufferedRecords + 2 * kLanePadding;

std::size_t row_room(const ManylightsBuilder& builder) {
    std::uint32_t rows = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) rows = std::max(rows, builder.grids[v].tiles_y);
    return rows + kLanePadding;
}

RecordBuffer buffer_of(ManylightsBuilder& builder, std::uint64_t tile_count, std::uint32_t task) {
    Windows& windows = builder.windows;
    std::uint32_t* words = windows.buffers.data() + 4 * kBufferRoom * task;
    const std::size_t room = row_room(builder);
    float* rows = windows.rows.data() + 4 * room * task;
    return {words,
            words + kBufferRoom,
            words + 2 * kBufferRoom,
            words + 3 * kBufferRoom,
            rows,
            rows + room,
            rows + 2 * room,
            rows + 3 * room,
            windows.cursors.data() + task * tile_count,
            windows.records.data()};
}

} // namespace

void Windows::use(const Allocator& allocator) {
    for (ViewSpans& view : spans) view.use(allocator);
    for (Array<std::uint32_t>* array : {&corners, &exponents, &begins, &cursors, &buffers, &scratch})
        array->use(allocator);
    planes.use(allocator);
    rows.use(allocator);
    records.use(allocator);
    tiles.use(allocator);
}

float choose_depth_scale(const std::uint32_t (&exponents)[256]) {
    constexpr int kLargestExponent = 126; // of a scale in this format
    std::uint64_t count = 0;
    for (const std::uint32_t bin : exponents) count += bin;
    std::uint64_t beyond = 0; // in the bins behind last
    int last = 255;
    while (last > 0 && beyond + exponents[last] <= count / 1024) beyond += exponents[last--];
    const int exponent = std::min(18 - (last - 126), kLargestExponent);
    return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
}

bool span_lights(ManylightsBuilder& builder, std::uint64_t tile_count, std::uint64_t& spanned) {
    Windows& windows = builder.windows;
    windows.light_tasks = light_task_count(builder, tile_count);
    const std::uint32_t tasks = windows.light_tasks;
    for (std::uint32_t v = 0; v < builder.view_count; ++v)
        if (!windows.spans[v].resize(builder.views[v].lights.block_count())) return false;
    if (!windows.corners.resize(tasks * all_corners(builder)) || !windows.exponents.resize(256 * kMaxViews * tasks) ||
        !windows.begins.resize(tile_count * tasks + 1) || !windows.cursors.resize(tile_count * tasks))
        return false;
    std::uint64_t sums[1024] = {};
    run_tasks(builder.settings, tasks, [&](std::uint32_t task) {
        sums[task] = span_task(builder, task);
        std::uint32_t* corners = windows.corners.data() + task * all_corners(builder);
        for (std::uint32_t v = 0; v < builder.view_count; ++v) {
            sum_corners(builder.grids[v], corners);
            corners += corner_count(builder.grids[v]);
        }
    });
    spanned = 0;
    for (const std::uint64_t sum : sums) spanned += sum;
    return true;
}

bool narrow_lights(ManylightsBuilder& builder, std::uint64_t tile_count, std::uint64_t spanned) {
    Windows& windows = builder.windows;
    const std::uint32_t tasks = windows.light_tasks;
    choose_scales(builder);
    place_buckets(builder, tile_count);
    NarrowView views[kMaxViews];
    if (!make_narrow_views(builder, views) || !windows.records.resize(spanned + kLanePadding) ||
        !windows.buffers.resize(4 * kBufferRoom * tasks) || !windows.rows.resize(4 * row_room(builder) * tasks))
        return false;
    run_tasks(builder.settings, tasks, [&](std::uint32_t task) {
        const RecordBuffer buffer = buffer_of(builder, tile_count, task);
        for (std::uint32_t v = 0; v < builder.view_count; ++v) {
            ViewLights& lights = builder.views[v].lights;
            const Part part = part_of(lights.block_count(), task, tasks);
            for (std::uint64_t b = part.begin; b < part.end; ++b)
                narrow_block(views[v], lights.block(b), windows.spans[v].block(b), buffer);
        }
    });
    return true;
}

// No more tasks than the largest tile leaves work for: each has room for that one.
bool prepare_tile_tasks(ManylightsBuilder& builder, std::uint64_t tile_count) {
    constexpr std::uint64_t kWorkPerTask = 1024; // records, and headers
    Windows& windows = builder.windows;
    const std::uint64_t spanned = windows.begins[tile_count * windows.light_tasks];
    const std::uint32_t tasks = task_count_for(builder.settings, spanned + kHeaderCells * tile_count, kWorkPerTask);
    const std::uint64_t useful = spanned / std::max(windows.largest_tile, 1u) + 1;
    windows.tile_tasks = static_cast<std::uint32_t>(std::min<std::uint64_t>(tasks, useful));
    const std::size_t room = windows.largest_tile + kLanePadding;
    return windows.scratch.resize(kScratchWords * room * windows.tile_tasks);
}

TileScratch tile_scratch(Windows& windows, std::uint32_t task) {
    const std::size_t room = windows.largest_tile + kLanePadding;
    std::uint32_t* words = windows.scratch.data() + kScratchWords * room * task;
    return {reinterpret_cast<WindowRecord*>(words), words + 3 * room, words + 4 * room, words + 5 * room,
            reinterpret_cast<WindowReference*>(words + 6 * room)};
}

std::uint32_t tile_record_count(const Windows& windows, std::uint64_t tile) {
    std::uint32_t count = 0;
    const std::uint64_t tile_count = windows.cursors.size() / windows.light_tasks;
    for (std::uint32_t task = 0; task < windows.light_tasks; ++task)
        count += windows.cursors[task * tile_count + tile] - windows.begins[tile * windows.light_tasks + task];
    return count;
}

const WindowRecord* tile_records(const Windows& windows, std::uint64_t tile, const TileScratch& scratch) {
    const std::uint32_t tasks = windows.light_tasks;
    if (tasks == 1) return windows.records.data() + windows.begins[tile];
    const std::uint64_t tile_count = windows.cursors.size() / tasks;
    WindowRecord* out = scratch.records;
    for (std::uint32_t task = 0; task < tasks; ++task) {
        const std::uint32_t begin = windows.begins[tile * tasks + task];
        const std::uint32_t count = windows.cursors[task * tile_count + tile] - begin;
        std::memcpy(out, windows.records.data() + begin, count * sizeof(WindowRecord));
        out += count;
    }
    return scratch.records;
}

} // namespace manylights::detail
