#pragma once
// Depth windows: a tile's references are ordered by where their depths begin, and each depth slice of the tile names
// the run of them that can reach it. See <manylights/format.h> for the layout. All decisions are made on integer depth
// codes, by one function for producer and reader.
//
//   sample   some lights, for the scale of depths, the size of tiles and the room for records   windows_sample.cpp
//   span     each light's tiles, by its pixels                                                  windows_span.cpp
//   narrow   its depths in each of them: records, put into the tile's chunks                    windows_narrow.cpp
//   measure  each tile's classes and slices, so its exact size                                  windows_tile.cpp
//   write    each tile's records in order, and the windows over them                            windows_write.cpp
//
// A block of lights is culled, spanned and narrowed while it is in the cache. Each light's and each tile's outcome is
// its own, and a tile keeps the order of the lights' blocks and, within a block, of the lights' spans. So it does not
// matter which task does what.

#include "src/build/bin.h"
#include "src/build/cull.h"
#include "src/format/layout.h"

#include <manylights/format.h>

#include <cstdint>
#include <initializer_list>

namespace manylights::detail {

constexpr std::uint64_t kHeaderCells = sizeof(MlTile) / sizeof(MlCell);

// One light in one tile, narrowed. Decided once, in plan; write replays it.
struct WindowRecord {
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

// What a block's lights span: parallel to its arrays.
struct BlockSpans {
    std::uint32_t *first_tile, *last_tile; // x | y << 16
    std::uint32_t* steps;                  // first and last in x, first and last in y, 4 bits each
    std::uint32_t* order;                  // positions in the block, by group
    std::uint32_t* ends;                   // of the groups in order
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
    float *before_offset, *before_depth, *behind_offset, *behind_depth;
};

// What narrowing needs to know of a view.
struct NarrowView {
    AxisPlanes columns, rows;
    float near_depth, far_depth; // of what is promised, widened
    float depth_scale;
    std::uint32_t tiles_x, first_tile;
    std::uint32_t full_steps; // the last step of a tile
};

// The records of all tiles, as one task finds them. A tile has its own in a chain of chunks; chunk 0 is none's.
constexpr std::uint32_t kChunkRecords = 16;
struct RecordPool {
    WindowRecord* records;
    std::uint32_t* next;    // per chunk: the tile's next one
    std::uint32_t* cursors; // per tile: behind its last record; 0: it has none
    std::uint32_t* firsts;  // per tile: its first chunk
    std::uint32_t* chunks;  // per tile: how many it has
    std::uint32_t capacity; // in chunks
    std::uint32_t used;     // also where that is more than there are: then the records are worth nothing
};

// Records on their way to their tiles, and room for the rows of one light.
struct RecordBuffer {
    std::uint32_t *tile, *light, *near_bits, *far_bits; // kBufferedRecords, and two vectors
    float *row_low, *row_high, *row_distance, *row_normal;
};
constexpr std::uint32_t kBufferedRecords = 512;

// Returns the number of records.
std::uint64_t narrow_block(const NarrowView& view, const LightBlock& lights, const BlockSpans& spans,
                           const RecordBuffer& buffer, RecordPool& pool);

struct WindowTile {
    std::uint32_t first_reference;
    std::uint32_t first_entry; // cell
    std::uint32_t base_code;
    std::uint32_t count;
    std::uint32_t small_bits; // extents of so many bits belong to the first class
    MlTileForm form;
};

struct WindowView {
    float depth_scale;
    std::uint64_t cell_offset, cell_count; // headers and entries
};

// As it stands in the references.
struct WindowReference {
    MlUint light, bounds;
};

// Some of a tile's records. A vector may be read where the last one begins.
struct RecordRun {
    const WindowRecord* records;
    std::uint32_t count;
};

// Scratch for the records of one tile.
struct TileScratch {
    RecordRun* runs;
    std::uint32_t* extents;
    std::uint32_t* lights;
    std::uint32_t* slices; // of the near end, with the class; of the far end << 16
    std::uint32_t* bounds;
    WindowReference* ordered;
};

// What one task needs.
struct WindowTask {
    RecordPool pool;
    std::uint64_t records;
    Ignored ignored;
};

// What the sampled lights of a view say about all of them.
struct WindowSample {
    std::uint64_t visible; // estimated
    double weight;         // lights per sampled one
};

struct Windows {
    WindowView views[kMaxViews];
    WindowSample samples[kMaxViews];
    Array<float> sample_floats;        // per view: a block
    Array<std::uint32_t> sample_words; // likewise
    Array<float> planes;               // of the views' columns and rows
    Array<WindowTask> tasks;           // that work on lights
    Array<WindowRecord> records;       // per task
    Array<std::uint32_t> next;         // per task, see RecordPool
    Array<std::uint32_t> chains;       // per task and tile: cursors, firsts, chunks
    Array<float> task_floats;          // per task: a block, and a buffer's rows
    Array<std::uint32_t> task_words;   // per task: a block, its spans, and a buffer
    Array<RecordRun> runs;             // per task that works on tiles
    Array<std::uint32_t> scratch;      // likewise
    Array<WindowTile> tiles;
    std::uint64_t tile_count = 0;
    std::uint32_t tile_tasks = 1; // that cut and write the tiles
    std::uint32_t largest_tile = 0;
    std::uint64_t references = 0;
    std::uint64_t empty_tiles = 0, flat_tiles = 0;

    void use(const Allocator& allocator);
};

// Codes per unit of depth: a power of two that gives nearly all lights (all but one in 1,024) a near end below 2^18, so
// that depths to 64 times as far have codes of their own. exponents: how many near ends have which; bin b holds those
// in [2^(b - 127), 2^(b - 126)), bin 0 also all that are less.
float choose_depth_scale(const std::uint32_t (&exponents)[256]);

TileScratch tile_scratch(Windows& windows, std::uint32_t task);

// A tile's records, in order. Returns the number of runs.
std::uint32_t list_runs(const Windows& windows, std::uint64_t tile, RecordRun* runs);
std::uint32_t tile_record_count(const Windows& windows, std::uint64_t tile);

// Chooses the classes and slices of a tile with count records. All of the result but where it begins. count is at least
// 1; extents is scratch.
WindowTile measure_tile(const RecordRun* runs, std::uint32_t run_count, std::uint32_t count, std::uint32_t* extents);

constexpr std::uint32_t kFlatReferences = 8; // up to so many, a table costs more than it saves

// The extents of a tile's depth ranges. Of up to kFlatReferences only the largest matters, and the others are left out.
struct Extents {
    std::uint32_t base_code, last_code;
    std::uint32_t counts[26];  // of those below 2^bits
    std::uint32_t largest[26]; // of those
};
Extents measure_extents(const RecordRun* runs, std::uint32_t run_count, std::uint32_t count, std::uint32_t* extents);

// Of each record: its light, its class and slices, and the bounds that go to the reference.
void describe_records(const WindowTile& tile, std::uint32_t run_count, const TileScratch& scratch);

constexpr std::uint32_t kClassSlices = 256; // slices of the large class are numbered from here

// Per slice of both classes: where its references end, and the first one of its window.
struct TileWindows {
    std::uint32_t end[2 * kClassSlices + 1];
    std::uint32_t first[2 * kClassSlices];
};

// Puts described records into their final order: scratch.ordered.
void order_records(const WindowTile& tile, const TileScratch& scratch, TileWindows& windows);

// The slice of a depth code that is not below the tile's base.
inline std::uint32_t slice_of_code(const WindowTile& tile, std::uint32_t code) {
    return (code - tile.base_code) >> tile.form.slice_shift;
}

} // namespace manylights::detail
