// Lights to records: each task culls, spans and narrows its blocks of lights, and keeps the records in chunks per tile.
#include "src/build/record_stages.h"

#include <algorithm>

namespace manylights::detail {

namespace {

constexpr std::size_t kBufferRoom = kBufferedRecords + 2 * kLanePadding;
constexpr std::size_t kTaskWords = 3 * std::size_t{kBlockRoom} + kSpanGroups + 4 * kBufferRoom;
constexpr std::uint64_t kMostChunks = UINT32_MAX / RecordPool::kChunk;

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
    const std::uint64_t affordable = 4 * estimate / std::max<std::uint64_t>(builder.records.tile_count, 1);
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(affordable, 1, tasks));
}

// A block's scratch in a task: what stays of its lights is their indices.
LightBlock block_of(ManylightsBuilder& builder, std::uint32_t task, View& view, std::uint64_t block) {
    return lay_out_block(builder.records.task_floats.data() + task_floats(builder) * task,
                         builder.records.task_words.data() + kTaskWords * task,
                         view.lights.index.data() + block * kBlockRoom);
}

BlockSpans spans_of(ManylightsBuilder& builder, std::uint32_t task) {
    std::uint32_t* const words = builder.records.task_words.data() + kTaskWords * task + 2 * kBlockRoom;
    const std::size_t first = std::size_t{kBlockRoom} * task;
    return {builder.records.spheres.data() + first, builder.records.spans.data() + first, words, words + kBlockRoom};
}

RecordBuffer buffer_of(ManylightsBuilder& builder, std::uint32_t task) {
    std::uint32_t* const words =
        builder.records.task_words.data() + kTaskWords * task + 3 * std::size_t{kBlockRoom} + kSpanGroups;
    const std::size_t room = row_room(builder);
    float* const rows = builder.records.task_floats.data() + task_floats(builder) * task + 4 * kBlockRoom;
    return {words, words + kBufferRoom, words + 2 * kBufferRoom, words + 3 * kBufferRoom,
            rows,  rows + room,         rows + 2 * room,         rows + 3 * room};
}

// Room for so many chunks of records, some of which are homes.
RecordPool empty_pool(TileRecords& records, std::uint32_t task, std::uint32_t capacity) {
    RecordPool pool = {records.records.data() + std::size_t{capacity} * RecordPool::kChunk * task,
                       records.cursors.data() + records.tile_count * task,
                       records.homes.data() + (records.tile_count + 1) * task,
                       records.firsts.data() + records.tile_count * task,
                       records.next.data() + std::size_t{capacity} * task,
                       0,
                       0,
                       0};
    const std::uint64_t room = std::uint64_t{capacity - capacity / 16 - 1} * RecordPool::kChunk;
    assign_homes(pool, records.counts.data() + records.tile_count * task, records.tile_count, room);
    pool.capacity = capacity - pool.chunks / RecordPool::kChunk - 1;
    return pool;
}

// In chunks, homes among them.
std::uint64_t used_room(const RecordPool& pool) {
    return pool.chunks / RecordPool::kChunk + std::uint64_t{pool.used} + 1;
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
    const auto task_count = static_cast<std::uint32_t>(builder.records.tasks.size());
    RecordTask result = {empty_pool(builder.records, task, job.capacity), 0, {0, 0}};
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
            result.records += narrow_block(job.narrows[v], spans, buffer, result.pool);
        }
        result.ignored = add_ignored(result.ignored, bad);
    }
    builder.records.tasks[task] = result;
}

bool make_room(ManylightsBuilder& builder, std::uint32_t task_count, std::uint64_t capacity) {
    TileRecords& records = builder.records;
    return records.tasks.resize(task_count) && records.records.resize(capacity * RecordPool::kChunk * task_count) &&
           records.next.resize(capacity * task_count) && records.cursors.resize(records.tile_count * task_count) &&
           records.firsts.resize(records.tile_count * task_count) &&
           records.homes.resize((records.tile_count + 1) * task_count) &&
           records.task_floats.resize(task_floats(builder) * task_count) &&
           records.task_words.resize(kTaskWords * task_count) &&
           records.spheres.resize(std::size_t{kBlockRoom} * task_count) &&
           records.spans.resize(std::size_t{kBlockRoom} * task_count);
}

// Chunks per task: what the sample lets expect, a chunk per tile that is begun, and a margin.
std::uint64_t expected_chunks(const TileRecords& records, std::uint32_t task_count, std::uint64_t estimate) {
    const std::uint64_t full = estimate / RecordPool::kChunk / task_count;
    return std::min(full + full / 8 + std::min(records.tile_count, estimate) + 64, kMostChunks);
}

void count_records(TileRecords& records) {
    std::uint32_t* out = records.counts.data();
    for (std::size_t task = 0; task < records.tasks.size(); ++task) {
        const RecordPool& pool = records.tasks[task].pool;
        for (std::uint64_t t = 0; t < records.tile_count; ++t) *out++ = list_length(pool, t);
    }
}

// What spans more than this, compared with what may be, does not fit when it is narrowed either.
constexpr std::uint64_t kNarrowsAway = 4;

// False: out of memory.
bool prepare_job(CollectJob& job) {
    ManylightsBuilder& builder = job.builder;
    if (!make_narrow_views(builder, job.narrows)) return false;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        job.culls[v] = make_view_cull(builder.views[v].camera, job.lights.motion_margin);
        job.spans[v] = {grid.tile_px, grid.width - 1, grid.height - 1};
        if (!builder.views[v].lights.resize(job.blocks)) return false;
    }
    return true;
}

// The chunks that the fullest task would have needed; counts the records.
std::uint64_t run_job(const CollectJob& job, std::uint32_t task_count) {
    TileRecords& records = job.builder.records;
    run_tasks(job.builder.settings, task_count, [&](std::uint32_t task) { collect_task(job, task); });
    std::uint64_t most_used = 0;
    records.count = 0;
    for (std::uint32_t task = 0; task < task_count; ++task) {
        most_used = std::max(most_used, used_room(records.tasks[task].pool));
        records.count += records.tasks[task].records;
    }
    return most_used;
}

} // namespace

void TileRecords::use(const Allocator& allocator) {
    for (Array<float>* array : {&sample_floats, &task_floats}) array->use(allocator);
    for (Array<std::uint32_t>* array : {&sample_words, &next, &firsts, &homes, &counts, &task_words})
        array->use(allocator);
    sample_spheres.use(allocator);
    planes.use(allocator);
    spheres.use(allocator);
    spans.use(allocator);
    tasks.use(allocator);
    cursors.use(allocator);
    records.use(allocator);
}

// Where the room was too little, all that is known is how much it takes: the second time it suffices.
Fit collect_records(ManylightsBuilder& builder, const ManylightsLights& lights, std::uint64_t limit, bool has_to_do) {
    const Fit too_many = has_to_do ? Fit::kTooLarge : Fit::kOverBudget;
    const std::uint64_t estimate = estimate_tiles(builder, builder.grids[0].tile_px);
    if (!has_to_do && estimate / kNarrowsAway > limit) return too_many;
    CollectJob job{builder, lights, block_count_for(lights.count), 0, {}, {}, {}};
    if (!prepare_job(job)) return Fit::kOutOfMemory;
    const std::uint32_t task_count = light_task_count(builder, job.blocks, estimate);
    if (!keep_lengths(builder.records.counts, builder.records.tile_count * task_count)) return Fit::kOutOfMemory;
    // The room that is there is used, too: where lights jump, homes are left half empty.
    std::uint64_t capacity = expected_chunks(builder.records, task_count, estimate);
    if (builder.records.tasks.size() == task_count)
        capacity = std::max<std::uint64_t>(capacity, builder.records.next.size() / task_count);
    for (;;) {
        if (!make_room(builder, task_count, capacity)) return Fit::kOutOfMemory;
        job.capacity = static_cast<std::uint32_t>(capacity);
        const std::uint64_t most_used = run_job(job, task_count);
        if (builder.records.count > limit || most_used > kMostChunks) return too_many;
        if (most_used <= capacity) break;
        capacity = std::min(most_used + most_used / 8, kMostChunks);
    }
    count_records(builder.records);
    return finish_culling(builder, builder.records.tasks) ? Fit::kFits : Fit::kOutOfMemory;
}

std::uint32_t tile_record_count(const TileRecords& records, std::uint64_t tile) {
    std::uint32_t count = 0;
    for (std::size_t task = 0; task < records.tasks.size(); ++task)
        count += records.counts[records.tile_count * task + tile];
    return count;
}

TileRuns list_runs(const TileRecords& records, std::uint64_t tile, RecordRun* runs) {
    std::uint32_t count = 0;
    for (std::size_t task = 0; task < records.tasks.size(); ++task)
        visit_list(records.tasks[task].pool, tile, [&](const TileRecord* first, std::uint32_t length) {
            runs[count++] = {first, length};
        });
    return {runs, count};
}

} // namespace manylights::detail
