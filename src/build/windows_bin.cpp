// Lights to records: each task culls, spans and narrows its blocks of lights, and keeps the records in chunks per tile.
#include "src/build/tasks.h"
#include "src/build/windows_plan.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstring>

namespace manylights::detail {

namespace {

constexpr std::size_t kBufferRoom = kBufferedRecords + 2 * kLanePadding;
constexpr std::size_t kTaskWords = 6 * std::size_t{kBlockRoom} + kSpanGroups + 4 * kBufferRoom;
constexpr std::uint64_t kMostChunks = UINT32_MAX / kChunkRecords;

std::size_t row_room(const ManylightsBuilder& builder) {
    std::uint32_t rows = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) rows = std::max(rows, builder.grids[v].tiles_y);
    return rows + kLanePadding;
}

std::size_t task_floats(const ManylightsBuilder& builder) {
    return 4 * std::size_t{kBlockRoom} + 4 * row_room(builder);
}

// Enough lights for each to pay for its own chains of all tiles.
std::uint32_t light_task_count(const ManylightsBuilder& builder, std::uint64_t blocks, std::uint64_t estimate) {
    const std::uint32_t tasks = task_count_for(builder.settings, blocks, 1);
    const std::uint64_t affordable = 4 * estimate / std::max<std::uint64_t>(builder.windows.tile_count, 1);
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(affordable, 1, tasks));
}

// A block's scratch in a task: what stays of its lights is their indices.
LightBlock block_of(ManylightsBuilder& builder, std::uint32_t task, View& view, std::uint64_t block) {
    float* const floats = builder.windows.task_floats.data() + task_floats(builder) * task;
    std::uint32_t* const words = builder.windows.task_words.data() + kTaskWords * task;
    return {floats,
            floats + kBlockRoom,
            floats + 2 * kBlockRoom,
            floats + 3 * kBlockRoom,
            view.lights.index.data() + block * kBlockRoom,
            words,
            words + kBlockRoom,
            0};
}

BlockSpans spans_of(ManylightsBuilder& builder, std::uint32_t task) {
    std::uint32_t* const words = builder.windows.task_words.data() + kTaskWords * task + 2 * kBlockRoom;
    return {words, words + kBlockRoom, words + 2 * kBlockRoom, words + 3 * kBlockRoom, words + 4 * kBlockRoom};
}

RecordBuffer buffer_of(ManylightsBuilder& builder, std::uint32_t task) {
    std::uint32_t* const words =
        builder.windows.task_words.data() + kTaskWords * task + 6 * std::size_t{kBlockRoom} + kSpanGroups;
    const std::size_t room = row_room(builder);
    float* const rows = builder.windows.task_floats.data() + task_floats(builder) * task + 4 * kBlockRoom;
    return {words, words + kBufferRoom, words + 2 * kBufferRoom, words + 3 * kBufferRoom,
            rows,  rows + room,         rows + 2 * room,         rows + 3 * room};
}

RecordPool empty_pool(Windows& windows, std::uint32_t task, std::uint32_t capacity) {
    std::uint32_t* const chains = windows.chains.data() + 3 * windows.tile_count * task;
    RecordPool pool = {windows.records.data() + std::size_t{capacity} * kChunkRecords * task,
                       windows.next.data() + std::size_t{capacity} * task,
                       chains,
                       chains + 2 * windows.tile_count,
                       chains + windows.tile_count,
                       capacity,
                       1};
    std::memset(chains, 0, 2 * windows.tile_count * sizeof(std::uint32_t)); // cursors and chunks
    return pool;
}

struct CollectJob {
    ManylightsBuilder& builder;
    const ManylightsLights& lights;
    std::uint64_t blocks;
    std::uint32_t capacity;
    ViewCull culls[kMaxViews];
    NarrowView narrows[kMaxViews];
    SpanView spans[kMaxViews];
};

void collect_task(const CollectJob& job, std::uint32_t task) {
    ManylightsBuilder& builder = job.builder;
    const auto task_count = static_cast<std::uint32_t>(builder.windows.tasks.size());
    WindowTask result = {empty_pool(builder.windows, task, job.capacity), 0, {0, 0}};
    const BlockSpans spans = spans_of(builder, task);
    const RecordBuffer buffer = buffer_of(builder, task);
    const Part part = part_of(job.blocks, task, task_count);
    for (std::uint64_t b = part.begin; b < part.end; ++b) {
        Ignored bad{}; // the same for all views
        for (std::uint32_t v = 0; v < builder.view_count; ++v) {
            LightBlock block = block_of(builder, task, builder.views[v], b);
            bad = cull_block(job.culls[v], block_span(job.lights, b), block);
            builder.views[v].lights.counts[b] = block.count;
            span_block(job.spans[v], block, spans);
            result.records += narrow_block(job.narrows[v], block, spans, buffer, result.pool);
        }
        result.ignored = add_ignored(result.ignored, bad);
    }
    builder.windows.tasks[task] = result;
}

bool make_room(ManylightsBuilder& builder, std::uint32_t task_count, std::uint64_t capacity) {
    Windows& windows = builder.windows;
    return windows.tasks.resize(task_count) && windows.records.resize(capacity * kChunkRecords * task_count) &&
           windows.next.resize(capacity * task_count) && windows.chains.resize(3 * windows.tile_count * task_count) &&
           windows.task_floats.resize(task_floats(builder) * task_count) &&
           windows.task_words.resize(kTaskWords * task_count);
}

// Chunks per task: what the sample lets expect, a chunk per tile that is begun, and a margin.
std::uint64_t expected_chunks(const Windows& windows, std::uint32_t task_count, std::uint64_t estimate) {
    const std::uint64_t full = estimate / kChunkRecords / task_count;
    return std::min(full + full / 8 + std::min(windows.tile_count, estimate) + 64, kMostChunks);
}

} // namespace

void Windows::use(const Allocator& allocator) {
    for (Array<float>* array : {&sample_floats, &planes, &task_floats}) array->use(allocator);
    for (Array<std::uint32_t>* array : {&sample_words, &next, &chains, &task_words, &scratch}) array->use(allocator);
    tasks.use(allocator);
    records.use(allocator);
    runs.use(allocator);
    tiles.use(allocator);
}

// Where the room was too little, all that is known is how much it takes: the second time it suffices.
Fit collect_records(ManylightsBuilder& builder, const ManylightsLights& lights, std::uint64_t estimate,
                    std::uint64_t limit) {
    Windows& windows = builder.windows;
    CollectJob job{builder, lights, block_count_for(lights.count), 0, {}, {}, {}};
    if (!make_narrow_views(builder, job.narrows)) return Fit::kOutOfMemory;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        job.culls[v] = make_view_cull(builder.views[v].camera, lights.motion_margin);
        job.spans[v] = {builder.grids[v].tile_px, builder.grids[v].width - 1, builder.grids[v].height - 1};
        if (!builder.views[v].lights.resize_indices(job.blocks)) return Fit::kOutOfMemory;
    }
    const std::uint32_t task_count = light_task_count(builder, job.blocks, estimate);
    std::uint64_t capacity = expected_chunks(windows, task_count, estimate);
    for (;;) {
        if (!make_room(builder, task_count, capacity)) return Fit::kOutOfMemory;
        job.capacity = static_cast<std::uint32_t>(capacity);
        run_tasks(builder.settings, task_count, [&](std::uint32_t task) { collect_task(job, task); });
        std::uint64_t most_used = 0;
        windows.references = 0;
        for (std::uint32_t task = 0; task < task_count; ++task) {
            most_used = std::max<std::uint64_t>(most_used, windows.tasks[task].pool.used);
            windows.references += windows.tasks[task].records;
        }
        if (windows.references > limit || most_used > kMostChunks) return Fit::kOverBudget;
        if (most_used <= capacity) break;
        capacity = std::min(most_used + most_used / 8, kMostChunks);
    }
    builder.ignored = {};
    for (std::uint32_t task = 0; task < task_count; ++task)
        builder.ignored = add_ignored(builder.ignored, windows.tasks[task].ignored);
    for (std::uint32_t v = 0; v < builder.view_count; ++v)
        if (!list_visible(builder.views[v])) return Fit::kOutOfMemory;
    return Fit::kFits;
}

std::uint32_t tile_record_count(const Windows& windows, std::uint64_t tile) {
    std::uint32_t count = 0;
    for (std::size_t task = 0; task < windows.tasks.size(); ++task) {
        const RecordPool& pool = windows.tasks[task].pool;
        if (pool.chunks[tile] != 0)
            count += (pool.chunks[tile] - 1) * kChunkRecords + (pool.cursors[tile] - 1) % kChunkRecords + 1;
    }
    return count;
}

std::uint32_t list_runs(const Windows& windows, std::uint64_t tile, RecordRun* runs) {
    std::uint32_t count = 0;
    for (std::size_t task = 0; task < windows.tasks.size(); ++task) {
        const RecordPool& pool = windows.tasks[task].pool;
        const std::uint32_t chunks = pool.chunks[tile];
        std::uint32_t chunk = pool.firsts[tile];
        for (std::uint32_t c = 1; c <= chunks; ++c) {
            const std::uint32_t records = c < chunks ? kChunkRecords : (pool.cursors[tile] - 1) % kChunkRecords + 1;
            const WindowRecord* at = pool.records + std::size_t{chunk} * kChunkRecords;
            runs[count++] = {at, records};
            // Chunks of a tile lie anywhere: without this their lines are waited for one after the other.
            for (std::uint32_t i = 0; i < records; i += 64 / sizeof(WindowRecord)) hwy::Prefetch(at + i);
            chunk = pool.next[chunk];
        }
    }
    return count;
}

} // namespace manylights::detail
