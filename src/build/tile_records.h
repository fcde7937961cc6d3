#pragma once
// Lights to tiles, for windows: each light is recorded in the tiles that its pixels span, with its depths there.
//
//   cull     which lights are in view                                                           cull_lanes.cpp
//   span     each light's tiles, by its pixels                                                  tile_spans.cpp
//   record   its depths in each of them, narrowed                                               windows_narrow.cpp
//
// A block of lights goes through all of that while it is in the cache. Records are kept in chunks per tile. Each
// light's outcome is its own, and a tile keeps the order of the lights' blocks and, within a block, of the lights'
// spans. So it does not matter which task does what.

#include "src/build/cull.h"
#include "src/build/grid.h"
#include "src/build/homes.h"
#include "src/format/layout.h"

#include <manylights/format.h>

#include <cstdint>

namespace manylights::detail {

// One light in one tile. Decided once, in plan; write replays it.
struct TileRecord {
    std::uint32_t light;     // the caller's index
    std::uint32_t near_bits; // depth code 24 bits, x0 4 bits, x1 4 bits
    std::uint32_t far_bits;  // depth code 24 bits, y0 4 bits, y1 4 bits

    std::uint32_t near_code() const { return near_bits & ML_DEPTH_CODE_MAX; }
    std::uint32_t far_code() const { return far_bits & ML_DEPTH_CODE_MAX; }
    std::uint32_t extent() const { return far_code() - near_code(); }
};

// Lights that span the same number of tiles take the same steps: they are narrowed together, without a branch.
constexpr std::uint32_t kSmallSpan = 4;                        // tiles per axis
constexpr std::uint32_t kSpanShapes = kSmallSpan * kSmallSpan; // of lights within the image
constexpr std::uint32_t kLargeSpan = 2 * kSpanShapes;          // behind them those that its edge cuts
constexpr std::uint32_t kSpanGroups = kLargeSpan + 1;          // and all others

// A block's lights, and what each spans: side by side, for they are read in another order.
struct SpanSphere {
    float x, y, depth, radius; // see LightBlock
};
struct SpanTiles {
    std::uint32_t light;
    std::uint32_t first, last; // x | y << 16
    std::uint32_t steps;       // first and last in x, first and last in y, 4 bits each
};
struct BlockSpans {
    SpanSphere* spheres;
    SpanTiles* tiles;
    std::uint32_t* order; // positions in the block, by group
    std::uint32_t* ends;  // of the groups in order
};

// What spanning needs to know of a view.
struct SpanView {
    std::uint32_t tile_px;
    std::uint32_t last_px_x, last_px_y;
};

void span_block(const SpanView& view, const LightBlock& lights, const BlockSpans& spans);

// How many tiles the lights of a block span, all together.
std::uint64_t count_tiles(const SpanView& view, const LightBlock& lights);

// The planes of a column or a row towards the one before and the one behind it.
struct AxisPlanes {
    float before_offset, before_depth, behind_offset, behind_depth;
};

// What narrowing needs to know of a view.
struct NarrowView {
    const AxisPlanes *columns, *rows;
    float near_depth, far_depth; // of what is promised, widened
    float depth_scale;
    std::uint32_t tiles_x, first_tile;
    std::uint32_t full_steps; // the last step of a tile
};

// The records of all tiles, as one task finds them.
using RecordPool = HomePool<TileRecord, HomeCursor, 32>;

// Records on their way to their tiles, and room for the rows of one light.
struct RecordBuffer {
    std::uint32_t *tile, *light, *near_bits, *far_bits; // kBufferedRecords, and two vectors
    float *row_low, *row_high, *cap_depth, *cap_radius;
};
constexpr std::uint32_t kBufferedRecords = 512;

// Returns the number of records.
std::uint64_t narrow_block(const NarrowView& view, const BlockSpans& spans, const RecordBuffer& buffer,
                           RecordPool& pool);

// Some of a tile's records. A vector may be read where the last one begins.
struct RecordRun {
    const TileRecord* records;
    std::uint32_t count;
};

struct TileRuns {
    const RecordRun* runs;
    std::uint32_t count;
};

// What one task needs.
struct RecordTask {
    RecordPool pool;
    std::uint64_t records;
    Ignored ignored;
};

// What the sampled lights of a view say about all of them.
struct LightSample {
    std::uint64_t visible;         // estimated
    double weight;                 // lights per sampled one
    float least_depth, most_depth; // where nearly all lights lie: powers of two; 0 without a light
    float large_radius;            // likewise: hardly any is larger
};

struct TileRecords {
    LightSample samples[kMaxViews];
    Array<ManylightsSphere> sample_spheres;
    Array<float> sample_floats;        // per view: a block
    Array<std::uint32_t> sample_words; // likewise
    Array<AxisPlanes> planes;          // of the views' columns and rows
    Array<RecordTask> tasks;           // that work on lights
    Array<TileRecord> records;         // per task
    Array<std::uint32_t> next;         // per task, see HomePool
    Array<HomeCursor> cursors;         // per task and tile
    Array<std::uint32_t> firsts;       // likewise
    Array<std::uint32_t> homes;        // likewise, and one behind
    Array<std::uint32_t> counts;       // per task and tile: records; while they are made, those of the last time, or 0
    Array<float> task_floats;          // per task: a block, and a buffer's rows
    Array<std::uint32_t> task_words;   // per task: a block, its order, and a buffer
    Array<SpanSphere> spheres;         // per task: a block's
    Array<SpanTiles> spans;            // likewise
    std::uint64_t tile_count = 0;      // of all views
    std::uint64_t count = 0;           // of records

    void use(const Allocator& allocator);
};

// A tile's records, in order.
TileRuns list_runs(const TileRecords& records, std::uint64_t tile, RecordRun* runs);
std::uint32_t tile_record_count(const TileRecords& records, std::uint64_t tile);
// Runs that a tile of so many records may have: each task may have a home for it, and leave a chunk unfilled.
inline std::size_t run_room(const TileRecords& records, std::uint32_t largest_tile) {
    return largest_tile / RecordPool::kChunk + 2 * records.tasks.size();
}

} // namespace manylights::detail
