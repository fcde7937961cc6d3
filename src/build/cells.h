#pragma once
// Structures with depth slices: lists, trees and hybrid. A tile's records are put into the order of their depths, and
// each of its slices takes those that reach it.
//
//   record   each light's depths, in each of its tiles                          grid_records.cpp, tile_records.h
//   sort     a tile's records by their depths, while they are in the cache      cells_lanes.cpp
//   measure  the lights of each cell, and whether they get a list or a tree     cells_plan.cpp, cells_lanes.cpp
//   write    nodes and references                                               cells_write.cpp, tree.cpp
//
// Nodes and references lie in the order of the tiles, and within a tile in that of its slices.

#include "src/build/settings.h"
#include "src/build/slices.h"
#include "src/build/tile_records.h"
#include "src/build/tree.h"

#include <cstdint>

namespace manylights::detail {

// The slices for whole vectors: a light reaches slice s where high >= begin[s] and low < end[s], which is
// slice_of(low) <= s <= slice_of(high).
struct SliceLanes {
    std::uint32_t count;
    float begin[kMaxSlices + kLanePadding], end[kMaxSlices + kLanePadding];
    // For the decision alone: the first slice begins at the near plane, the last one ends at slice_far or with the
    // farthest light, whichever is more.
    float near_depth[kMaxSlices + kLanePadding], far_depth[kMaxSlices + kLanePadding];
};
SliceLanes make_slice_lanes(const Slices& slices, double camera_near, float slice_far, float farthest);

// Lights in three arrays.
struct DepthArrays {
    std::uint32_t* light;
    float *low, *high;
};

// Scratch for the records of one tile.
struct SortScratch {
    float* middles;
    std::uint32_t* keys;
};

// A tile's lights by the middle of their depths: as exact as a bin or two per light are.
void sort_records(const TileRuns& runs, std::uint32_t count, const SortScratch& scratch, const DepthArrays& sorted);

// Per slice: how many of a tile's lights reach it, the sum of their depths within it, and where they are among the
// sorted ones: from the first to the last of them, others between.
struct SliceSums {
    std::uint32_t counts[kMaxSlices + kLanePadding];
    float depths[kMaxSlices + kLanePadding];
    std::uint32_t first[kMaxSlices + kLanePadding], end[kMaxSlices + kLanePadding];
};
void measure_slices(const SliceLanes& slices, const DepthArrays& sorted, std::uint32_t count, SliceSums& sums);

// Of the sorted lights [begin, end) those that reach the slice, in order; returns how many.
std::uint32_t pick_slice(const SliceLanes& slices, std::uint32_t slice, const DepthArrays& sorted, std::uint32_t begin,
                         std::uint32_t end, const DepthArrays& cell);

// Does a tree serve a cell better than a list? The mean over its lights of the depth range that lies in the cell is
// compared with half of the cell's depth.
bool prefers_tree(std::uint32_t count, float sum_of_depths, float cell_near, float cell_far);

struct GridTile {
    std::uint32_t first_record; // where its lights are among the sorted ones of all tiles
    std::uint32_t record_count;
    std::uint32_t first_reference, first_node;
    std::uint16_t list_cells, tree_cells;
    std::uint64_t reference_count, node_count;
};

// Of a tile and a slice.
struct GridCell {
    std::uint32_t count;      // lights
    std::uint32_t begin, end; // among the tile's sorted lights: all of the cell's are there
    std::uint32_t first;      // node (lists: reference), from the tile's first
};

struct Cells {
    Array<GridTile> tiles;
    Array<GridCell> cells;       // per tile: its slices; not set where it has no record
    Array<std::uint8_t> is_tree; // likewise
    Array<std::uint32_t> sorted_lights;
    Array<float> sorted_low, sorted_high;
    Array<RecordRun> runs;        // per task that works on tiles
    Array<std::uint32_t> scratch; // likewise
    Array<DepthSpan> heaps;       // likewise
    SliceLanes slices[kMaxViews];
    std::uint32_t tile_tasks = 1;
    std::uint32_t largest_tile = 0;
    std::uint64_t list_cells = 0, tree_cells = 0;

    DepthArrays sorted(const GridTile& tile) {
        return {sorted_lights.data() + tile.first_record, sorted_low.data() + tile.first_record,
                sorted_high.data() + tile.first_record};
    }
    void use(const Allocator& allocator);
};

// Scratch of a task that works on tiles.
struct CellScratch {
    RecordRun* runs;
    SortScratch sort;
    DepthArrays cell;
    DepthSpan* heap;
};

} // namespace manylights::detail
