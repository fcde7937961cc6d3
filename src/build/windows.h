#pragma once
// Depth windows: a tile's references are ordered by where their depths begin, and each depth slice of the tile names
// the run of them that can reach it. See <manylights/format.h> for the layout. All decisions are made on integer depth
// codes, by one function for producer and reader.
//
//   span     each light's tiles, by its pixels; how many of them each tile has at the most     windows_span.cpp
//   narrow   each light's depths in each of its tiles: records, put into their tile's bucket   windows_narrow.cpp
//   measure  each tile's classes and slices, so its exact size                                 windows_tile.cpp
//   write    each tile's records in order, and the windows over them                           windows_write.cpp
//
// Each light's and each tile's outcome is its own, and a bucket keeps the order of the lights' blocks and, within a
// block, of the lights' spans. So it does not matter which task does what.

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

// The spans of a view's lights, in blocks as the lights.
struct ViewSpans {
    Array<std::uint32_t> first_tile, last_tile, steps, order, ends;

    void use(const Allocator& allocator);
    [[nodiscard]] bool resize(std::uint64_t block_count);
    BlockSpans block(std::uint64_t index_of_block);
};

// What spanning needs to know of a view.
struct SpanView {
    std::uint32_t tile_px, tiles_x;
    std::uint32_t last_px_x, last_px_y;
};

// What spanning finds beside the spans.
struct SpanCounts {
    std::uint32_t* corners;       // (tiles_x + 1) * (tiles_y + 1): sums of them are the lights of a tile
    std::uint32_t exponents[256]; // of the near ends; bin b holds [2^(b - 127), 2^(b - 126)), bin 0 also all less
    std::uint64_t tiles;          // of all lights together
};

void span_block(const SpanView& view, const LightBlock& lights, const BlockSpans& spans, SpanCounts& counts);

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

// Records on their way to their tiles' buckets, and room for the rows of one light.
struct RecordBuffer {
    std::uint32_t *tile, *light, *near_bits, *far_bits; // kBufferedRecords, and two vectors
    float *row_low, *row_high, *row_distance, *row_normal;
    std::uint32_t* cursors; // per tile, the end of its bucket so far
    WindowRecord* records;
};
constexpr std::uint32_t kBufferedRecords = 512;

void narrow_block(const NarrowView& view, const LightBlock& lights, const BlockSpans& spans,
                  const RecordBuffer& buffer);

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

// Scratch for the records of one tile.
struct TileScratch {
    WindowRecord* records; // where they are in several buckets
    std::uint32_t* extents;
    std::uint32_t* slices; // of the near end, with the class; of the far end << 16
    std::uint32_t* bounds;
    WindowReference* ordered;
};
constexpr std::size_t kScratchWords = 3 + 1 + 1 + 1 + 2; // per record

struct Windows {
    WindowView views[kMaxViews];
    ViewSpans spans[kMaxViews];
    Array<std::uint32_t> corners;   // per task: see SpanCounts
    Array<std::uint32_t> exponents; // per task and view, likewise
    Array<float> planes;            // of the views' columns and rows
    Array<std::uint32_t> begins;    // per tile and task: where its bucket begins
    Array<std::uint32_t> cursors;   // per task and tile: where it ends
    Array<WindowRecord> records;    // buckets: per tile and task
    Array<std::uint32_t> buffers;   // per task
    Array<float> rows;              // per task
    Array<std::uint32_t> scratch;   // per task
    Array<WindowTile> tiles;
    std::uint32_t light_tasks = 1; // that fill the buckets
    std::uint32_t tile_tasks = 1;  // that cut and write the tiles
    std::uint32_t largest_tile = 0;
    std::uint64_t references = 0;
    std::uint64_t empty_tiles = 0, flat_tiles = 0;

    void use(const Allocator& allocator);
};

// Codes per unit of depth: a power of two that gives nearly all lights (all but one in 1,024) a near end below 2^18, so
// that depths to 64 times as far have codes of their own. exponents: see SpanCounts.
float choose_depth_scale(const std::uint32_t (&exponents)[256]);

// A tile's records: those of its buckets, in order, in one place; and how many there are.
const WindowRecord* tile_records(const Windows& windows, std::uint64_t tile, const TileScratch& scratch);
std::uint32_t tile_record_count(const Windows& windows, std::uint64_t tile);
TileScratch tile_scratch(Windows& windows, std::uint32_t task);

// Chooses the classes and slices of a tile. All of the result but where it begins. count is at least 1; records may be
// read up to a vector behind the last one.
WindowTile measure_tile(const WindowRecord* records, std::uint32_t count, std::uint32_t* extents);

constexpr std::uint32_t kFlatReferences = 8; // up to so many, a table costs more than it saves

// The extents of a tile's depth ranges. Of up to kFlatReferences only the largest matters, and the others are left out.
struct Extents {
    std::uint32_t base_code, last_code;
    std::uint32_t counts[26];  // of those below 2^bits
    std::uint32_t largest[26]; // of those
};
Extents measure_extents(const WindowRecord* records, std::uint32_t count, std::uint32_t* extents);

// Of each record, in place: its class and slices, and the bounds that go to the reference.
void describe_records(const WindowTile& tile, const WindowRecord* records, const TileScratch& scratch);

constexpr std::uint32_t kClassSlices = 256; // slices of the large class are numbered from here

// Per slice of both classes: where its references end, and the first one of its window.
struct TileWindows {
    std::uint32_t end[2 * kClassSlices + 1];
    std::uint32_t first[2 * kClassSlices];
};

// Puts described records into their final order: scratch.ordered.
void order_records(const WindowTile& tile, const WindowRecord* records, const TileScratch& scratch,
                   TileWindows& windows);

// The slice of a depth code that is not below the tile's base.
inline std::uint32_t slice_of_code(const WindowTile& tile, std::uint32_t code) {
    return (code - tile.base_code) >> tile.form.slice_shift;
}

} // namespace manylights::detail
