#pragma once
// Structures with depth slices: lists, trees and hybrid. All lights are put into the order of their depths, once; then
// each cell gets its lights in that order.
//
//   box      each light's depths, and the box of cells that it reaches      light_boxes.cpp
//   sort     the boxes by depth                                             box_order.cpp
//   deal     a record of each light to the cells of its box                 deal_lights.cpp, cell_pools.cpp
//   measure  the lights of each cell, and whether they get a list or a tree cells_plan.cpp
//   write    cells, nodes and references                                    cells_write.cpp, tree.cpp
//
// Cells lie as in the caller's buffer: tile x fastest, then tile y, then slice; and so do their nodes and references.
// Lights that follow each other in depth reach few slices, so that dealing goes through all cells once.

#include "src/build/cull.h"
#include "src/build/depth_codes.h"
#include "src/build/grid.h"
#include "src/build/homes.h"
#include "src/build/settings.h"
#include "src/build/slices.h"
#include "src/build/tree.h"

#include <cstdint>

namespace manylights::detail {

// A light, and the cells that it reaches: columns x rows tiles of the slices that its depths reach.
struct LightBox {
    DepthSpan span;
    std::uint32_t light, first_cell;
    std::uint32_t tiles; // columns - 1 | rows - 1 << 16
};

// The order of lights: by bands of depth, each with about as many lights; before all of them the few that are larger
// than nearly all others, by bands of depth, too. In a band they keep the caller's order. A code's band is interpolated
// between those of every kBandStep-th code.
//
//   | large lights, count / 8 bands | all others, count bands |
constexpr int kBandShift = 10;
constexpr std::uint32_t kBandStep = 1u << kBandShift;
constexpr std::uint32_t kBandSteps = (1u << DepthCodes::kLowBits) >> kBandShift;
constexpr int kLargeShift = 3;
struct DepthBands {
    std::uint32_t first; // of the view
    std::uint32_t count; // of all others'
    float large_radius;
    DepthCodes codes;           // of near ends alone, for 32 octaves
    const std::uint32_t* steps; // kBandSteps + 1
};

// What boxing needs to know of a view.
struct BoxView {
    std::uint32_t tile_px, tiles_x, tile_count, first_cell;
    const Slices* slices;
    DepthCodes codes;
    DepthBands bands;
};

// A block's boxes: in the order of its lights.
struct BlockBoxes {
    LightBox* boxes;
    std::uint32_t* bands;
};

// Of the lights of some blocks: where the farthest one ends, and how many cells they reach.
struct BoxSums {
    float farthest;
    std::uint64_t cells;
};
void box_block(const BoxView& view, const LightBlock& lights, const BlockBoxes& to, BoxSums& sums);

// Where slices begin and end for the decision alone: the first one begins at the near plane, the last one ends at
// slice_far or with the farthest light, whichever is more. An extent is measured in 1/256 of that.
constexpr std::int32_t kWholeExtent = 256;
struct SliceExtents {
    float edges[kMaxSlices + 1];
};
SliceExtents make_slice_extents(const Slices& slices, double camera_near, float slice_far, float farthest);

// Does a tree serve a cell better than a list? Where its lights' extents within the slice, less half of the slice each,
// are less than 0 together. The sum wraps where a cell has more than 2^24 lights: it decides about speed alone.
inline bool prefers_tree(std::uint32_t extent_sum) { return extent_sum >> 31 != 0; }

// A light in a cell.
struct CellRecord {
    std::uint32_t light;
    DepthSpan span;
};

// The lights of all cells, as one task deals them.
struct CellCursor : HomeCursor {
    std::uint32_t extent_sum; // see prefers_tree
};
using CellPool = HomePool<CellRecord, CellCursor, 16>;

// Lights that are dealt without regard to others: [begin, end) in the order of depths, all of one view.
struct Segment {
    std::uint32_t begin, end;
};
constexpr std::uint32_t kSegmentLights = 1024;

// A plate is the cells of a box in one slice: those of lights that are dealt together.
constexpr std::uint32_t kDealtTogether = 16;
constexpr std::uint32_t kPlateRoom = kDealtTogether * kMaxSlices + kLanePadding;
struct PlateBuffer {
    std::uint32_t *first_cell, *tiles, *words; // kPlateRoom each
};

// Records on their way to their cells.
struct DealBuffer {
    CellRecord* segment;  // those of a segment's lights: kSegmentLights, and kLanePadding more
    std::uint32_t* cells; // kBufferedLights, and 2 * kLanePadding more
    std::uint32_t* words; // likewise: light in the segment | extent << 16
    PlateBuffer plates;
};
constexpr std::uint32_t kBufferedLights = 512;

// What dealing needs to know of a view.
struct DealView {
    std::uint32_t tiles_x, tile_count;
    const Slices* slices;
    DepthCodes codes;
    const SliceExtents* extents; // null: nothing is decided by them
};

// How many cells the lights reach, all together.
std::uint64_t count_segment(const DealView& view, const LightBox* boxes, Segment segment);
void deal_segment(const DealView& view, const LightBox* boxes, Segment segment, const DealBuffer& buffer,
                  CellPool& pool);

// What plan decides of a cell.
struct GridCell {
    std::uint32_t count; // lights
    std::uint32_t node_count : 31;
    std::uint32_t is_tree : 1;
};

// Cells side by side: the work is shared, and places are kept, by blocks of them.
constexpr std::uint32_t kBlockCells = 32;
struct CellBlock {
    std::uint64_t first_reference, first_node; // while they are counted: how many
    std::uint32_t list_cells, tree_cells;
    std::uint32_t largest; // lights of a cell
};

// What a task that culls finds out.
struct BoxTask {
    Ignored ignored;
    BoxSums sums[kMaxViews];
};

struct Cells {
    // Per view and block of lights, see ViewLights.
    Array<LightBox> found;
    Array<std::uint32_t> found_bands; // then: places in their order
    // In order, one view's behind the other's.
    Array<LightBox> boxes;
    std::uint32_t first_light[kMaxViews + 1];
    Array<std::uint32_t> band_steps; // per view, see DepthBands
    // Of the tasks that cull and sort.
    Array<BoxTask> box_tasks;
    Array<std::uint32_t> bands; // per task and band: lights, then the place of the next one
    Array<float> block_floats;
    Array<std::uint32_t> block_pixels;
    // Of the tasks that deal.
    Array<std::uint64_t> segments; // per segment, and behind the last one: the references before it
    Array<CellPool> pools;         // per task
    Array<CellCursor> cursors;     // per task and cell
    Array<std::uint32_t> homes, firsts;
    Array<std::uint32_t> counts; // likewise: records; while they are dealt, those of the last time, or 0
    Array<CellRecord> records;
    Array<std::uint32_t> next;
    Array<CellRecord> segment_records; // per task
    Array<std::uint32_t> buffers;      // likewise
    SliceExtents extents[kMaxViews];
    DepthCodes codes[kMaxViews];
    // What comes of it.
    Array<GridCell> cells;
    Array<CellBlock> blocks; // and one behind the last
    Array<DepthSpan> spans;  // per task that writes, of a cell's lights
    Array<NodeDepths> heaps; // likewise
    std::uint32_t write_tasks = 1;

    std::uint32_t largest_cell() const { return blocks[blocks.size() - 1].largest; }
    void use(const Allocator& allocator);
};

} // namespace manylights::detail
