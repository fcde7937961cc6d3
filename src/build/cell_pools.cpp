// The records of all cells: segments of lights are dealt by tasks, each into a pool of its own.
#include "src/build/record_stages.h"

#include <algorithm>

namespace manylights::detail {

namespace {

constexpr std::size_t kBufferRoom = kBufferedLights + 2 * std::size_t{kLanePadding};
constexpr std::size_t kBufferWords = 2 * kBufferRoom + 3 * std::size_t{kPlateRoom};
constexpr std::size_t kSegmentRoom = kSegmentLights + std::size_t{kLanePadding};

std::uint64_t segment_count_of(const Cells& cells, std::uint32_t view) {
    return divide_up(cells.first_light[view + 1] - cells.first_light[view], kSegmentLights);
}

std::uint64_t all_segments(const ManylightsBuilder& builder) {
    std::uint64_t segments = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) segments += segment_count_of(builder.cells, v);
    return segments;
}

// Calls visit(view, segment) for the segments [begin, end) of all views.
template <typename Visit>
void visit_segments(const ManylightsBuilder& builder, std::uint64_t begin, std::uint64_t end, const Visit& visit) {
    const Cells& cells = builder.cells;
    std::uint64_t before = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const std::uint64_t count = segment_count_of(cells, v);
        for (std::uint64_t s = std::max(begin, before); s < std::min(end, before + count); ++s) {
            const auto first = cells.first_light[v] + static_cast<std::uint32_t>(s - before) * kSegmentLights;
            visit(v, Segment{first, first + std::min(kSegmentLights, cells.first_light[v + 1] - first)});
        }
        before += count;
    }
}

DealView deal_view(const ManylightsBuilder& builder, std::uint32_t v) {
    const Grid& grid = builder.grids[v];
    return {grid.tiles_x, static_cast<std::uint32_t>(grid.tile_count), &builder.slices, builder.cells.codes[v],
            builder.settings.structure == MANYLIGHTS_STRUCTURE_HYBRID ? &builder.cells.extents[v] : nullptr};
}

// Where several tasks share the segments: what each deals, then what is dealt before it. False: out of memory.
bool count_segments(ManylightsBuilder& builder, std::uint32_t task_count) {
    Cells& cells = builder.cells;
    const std::uint64_t segments = all_segments(builder);
    if (!cells.segments.resize(segments + 1)) return false;
    cells.segments.fill_zero();
    if (task_count == 1) {
        cells.segments[segments] = builder.counts.references;
        return true;
    }
    run_tasks(builder.settings, task_count, [&](std::uint32_t task) {
        const Part part = part_of(segments, task, task_count);
        std::uint64_t* out = cells.segments.data() + part.begin;
        visit_segments(builder, part.begin, part.end, [&](std::uint32_t v, Segment segment) {
            *out++ = count_segment(deal_view(builder, v), cells.boxes.data(), segment);
        });
    });
    std::uint64_t before = 0;
    for (std::uint64_t s = 0; s <= segments; ++s) {
        const std::uint64_t here = cells.segments[s];
        cells.segments[s] = before;
        before += here;
    }
    return true;
}

Part segments_of(const Cells& cells, std::uint32_t task, std::uint32_t task_count) {
    const std::uint64_t segments = cells.segments.size() - 1;
    const auto before = [&](std::uint64_t segment) { return cells.segments[segment]; };
    const Part records = part_of(before(segments), task, task_count);
    return {first_with(segments, records.begin, before),
            task + 1 == task_count ? segments : first_with(segments, records.end, before)};
}

// Enough records for each task to pay for its own cursors of all cells.
std::uint32_t deal_task_count(const ManylightsBuilder& builder) {
    const std::uint64_t affordable = builder.counts.references / std::max<std::uint64_t>(builder.counts.cells, 1);
    return static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(affordable, 1, task_count_for(builder.settings, all_segments(builder), 1)));
}

// Records that a pool has room for. A cell leaves its last chunk unfilled, so chunks suffice if no cell has a home.
struct PoolRoom {
    std::uint64_t homes, chunks;
};
PoolRoom pool_room(std::uint64_t records, std::uint64_t cells) {
    const std::uint64_t begun = std::min(records, cells);
    return {records + records / 4 + begun * CellPool::kChunk, records / CellPool::kChunk + begun};
}

// False: out of memory, or more than positions can count.
bool make_pools(ManylightsBuilder& builder, std::uint32_t task_count) {
    Cells& cells = builder.cells;
    const std::size_t count = builder.counts.cells;
    if (!cells.pools.resize(task_count) || !cells.cursors.resize(count * task_count) ||
        !cells.homes.resize((count + 1) * task_count) || !cells.firsts.resize(count * task_count) ||
        !cells.buffers.resize(kBufferWords * task_count) || !cells.segment_records.resize(kSegmentRoom * task_count) ||
        !keep_lengths(cells.counts, count * task_count))
        return false;
    std::uint64_t records = 0;
    std::uint64_t chunks = 0;
    for (std::uint32_t task = 0; task < task_count; ++task) {
        const Part part = segments_of(cells, task, task_count);
        const PoolRoom room = pool_room(cells.segments[part.end] - cells.segments[part.begin], count);
        if (room.homes + room.chunks * CellPool::kChunk > UINT32_MAX) return false;
        records += room.homes + room.chunks * CellPool::kChunk;
        chunks += room.chunks;
    }
    if (!cells.records.resize(records) || !cells.next.resize(chunks)) return false;
    records = chunks = 0;
    for (std::uint32_t task = 0; task < task_count; ++task) {
        const Part part = segments_of(cells, task, task_count);
        const PoolRoom room = pool_room(cells.segments[part.end] - cells.segments[part.begin], count);
        cells.pools[task] = {cells.records.data() + records,
                             cells.cursors.data() + count * task,
                             cells.homes.data() + (count + 1) * task,
                             cells.firsts.data() + count * task,
                             cells.next.data() + chunks,
                             static_cast<std::uint32_t>(room.homes),
                             static_cast<std::uint32_t>(room.chunks),
                             0};
        records += room.homes + room.chunks * CellPool::kChunk;
        chunks += room.chunks;
    }
    return true;
}

void deal_task(ManylightsBuilder& builder, std::uint32_t task) {
    Cells& cells = builder.cells;
    const auto task_count = static_cast<std::uint32_t>(cells.pools.size());
    CellPool pool = cells.pools[task];
    assign_homes(pool, cells.counts.data() + builder.counts.cells * task, builder.counts.cells, pool.chunks);
    std::uint32_t* const words = cells.buffers.data() + kBufferWords * task;
    std::uint32_t* const plates = words + 2 * kBufferRoom;
    const DealBuffer buffer = {cells.segment_records.data() + kSegmentRoom * task,
                               words,
                               words + kBufferRoom,
                               {plates, plates + kPlateRoom, plates + 2 * std::size_t{kPlateRoom}}};
    const Part part = segments_of(cells, task, task_count);
    visit_segments(builder, part.begin, part.end, [&](std::uint32_t v, Segment segment) {
        deal_segment(deal_view(builder, v), cells.boxes.data(), segment, buffer, pool);
    });
    cells.pools[task] = pool;
}

} // namespace

bool deal_lights(ManylightsBuilder& builder) {
    const std::uint32_t task_count = deal_task_count(builder);
    if (!count_segments(builder, task_count) || !make_pools(builder, task_count)) return false;
    run_tasks(builder.settings, task_count, [&](std::uint32_t task) { deal_task(builder, task); });
    return true;
}

} // namespace manylights::detail
