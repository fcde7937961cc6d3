// Replays the cells that plan decided: cells, nodes and references.
#include "src/build/record_stages.h"

#include <algorithm>
#include <cstring>

namespace manylights::detail {

namespace {

// Of the tiles [begin, end), all of one view: ascending.
void write_cells(const ManylightsBuilder& builder, const Grid& grid, std::uint64_t begin, std::uint64_t end,
                 MlCell* out) {
    const Cells& cells = builder.cells;
    const bool lists = builder.settings.structure == MANYLIGHTS_STRUCTURE_LISTS;
    for (std::uint32_t s = 0; s < grid.slice_count; ++s) {
        for (std::uint64_t t = begin; t < end; ++t) {
            const std::uint64_t cell = t * grid.slice_count + s;
            const GridTile& tile = cells.tiles[t];
            const std::uint32_t behind = s + 1 < grid.slice_count ? cells.firsts[cell + 1]
                                         : lists                  ? tile.reference_count
                                                                  : tile.node_count;
            const std::uint32_t first = lists ? tile.first_reference : tile.first_node;
            out[grid.cell_offset() + s * grid.tile_count + (t - grid.tile_offset)] = {first + cells.firsts[cell],
                                                                                      behind - cells.firsts[cell]};
        }
    }
}

struct Destination {
    MlNode* nodes;
    MlUint* references;
    std::uint32_t first_reference;
};

void write_cell(const ManylightsBuilder& builder, std::uint64_t cell, const DepthArrays& lights, DepthSpan* heap,
                Destination& to) {
    const std::uint32_t count = builder.cells.counts[cell];
    const CellLights of_cell = {lights.low, lights.high, count, to.first_reference};
    if (builder.cells.is_tree[cell] != 0)
        to.nodes = write_trees(of_cell, builder.settings.leaf_size, heap, to.nodes);
    else if (builder.settings.structure != MANYLIGHTS_STRUCTURE_LISTS)
        to.nodes = write_list(of_cell, to.nodes);
    std::memcpy(to.references, lights.light, count * sizeof(MlUint));
    to.references += count;
    to.first_reference += count;
}

void write_tile(const ManylightsBuilder& builder, const SliceLanes& slices, std::uint64_t t, const CellScratch& scratch,
                const ManylightsBuffers& buffers) {
    const GridTile& tile = builder.cells.tiles[t];
    if (tile.record_count == 0) return;
    sort_records(list_runs(builder.records, t, scratch.runs), tile.record_count, scratch);
    Destination to = {static_cast<MlNode*>(buffers.nodes) + tile.first_node,
                      static_cast<MlUint*>(buffers.references) + tile.first_reference, tile.first_reference};
    if (slices.count == 1) return write_cell(builder, t, scratch.sorted, scratch.heap, to);
    SliceRanges ranges;
    find_ranges(slices, scratch.sorted, tile.record_count, ranges);
    for (std::uint32_t s = 0; s < slices.count; ++s) {
        if (builder.cells.counts[t * slices.count + s] == 0) continue;
        pick_slice(slices, s, scratch.sorted, ranges.first[s], ranges.end[s], scratch.cell);
        write_cell(builder, t * slices.count + s, scratch.cell, scratch.heap, to);
    }
}

} // namespace

void write_cell_tiles(ManylightsBuilder& builder, std::uint32_t task, std::uint64_t begin, std::uint64_t end,
                      const ManylightsBuffers& buffers) {
    const CellScratch scratch = cell_scratch(builder, task);
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        const std::uint64_t first = std::max(begin, grid.tile_offset);
        const std::uint64_t last = std::min(end, grid.tile_offset + grid.tile_count);
        if (first >= last) continue;
        write_cells(builder, grid, first, last, static_cast<MlCell*>(buffers.cells));
        for (std::uint64_t t = first; t < last; ++t) write_tile(builder, builder.cells.slices[v], t, scratch, buffers);
    }
}

} // namespace manylights::detail
