// Replays the cells that plan decided: cells, nodes and references.
#include "src/build/record_stages.h"

#include <algorithm>
#include <cstring>

namespace manylights::detail {

namespace {

MlCell describe_cell(const Cells& cells, const Grid& grid, std::uint64_t t, std::uint32_t slice, bool lists) {
    const GridTile& tile = cells.tiles[t];
    const std::uint32_t first = lists ? tile.first_reference : tile.first_node;
    if (tile.record_count == 0) return {first, 0};
    const GridCell* const cell = &cells.cells[t * grid.slice_count + slice];
    const std::uint64_t behind = slice + 1 < grid.slice_count ? cell[1].first
                                 : lists                      ? tile.reference_count
                                                              : tile.node_count;
    return {first + cell->first, static_cast<std::uint32_t>(behind) - cell->first};
}

// Of the tiles [begin, end), all of one view: ascending.
void write_cells(const ManylightsBuilder& builder, const Grid& grid, std::uint64_t begin, std::uint64_t end,
                 MlCell* out) {
    const bool lists = builder.settings.structure == MANYLIGHTS_STRUCTURE_LISTS;
    for (std::uint32_t s = 0; s < grid.slice_count; ++s)
        for (std::uint64_t t = begin; t < end; ++t)
            out[grid.cell_offset() + s * grid.tile_count + (t - grid.tile_offset)] =
                describe_cell(builder.cells, grid, t, s, lists);
}

struct Destination {
    MlNode* nodes;
    MlUint* references;
    std::uint32_t first_reference;
};

void write_cell(const ManylightsBuilder& builder, bool is_tree, const DepthArrays& lights, std::uint32_t count,
                DepthSpan* heap, Destination& to) {
    const CellLights of_cell = {lights.low, lights.high, count, to.first_reference};
    if (is_tree)
        to.nodes = write_trees(of_cell, builder.settings.leaf_size, heap, to.nodes);
    else if (builder.settings.structure != MANYLIGHTS_STRUCTURE_LISTS)
        to.nodes = write_list(of_cell, to.nodes);
    std::memcpy(to.references, lights.light, count * sizeof(MlUint));
    to.references += count;
    to.first_reference += count;
}

void write_tile(ManylightsBuilder& builder, const SliceLanes& slices, std::uint64_t t, const CellScratch& scratch,
                const ManylightsBuffers& buffers) {
    Cells& cells = builder.cells;
    const GridTile& tile = cells.tiles[t];
    if (tile.record_count == 0) return;
    const DepthArrays sorted = cells.sorted(tile);
    Destination to = {static_cast<MlNode*>(buffers.nodes) + tile.first_node,
                      static_cast<MlUint*>(buffers.references) + tile.first_reference, tile.first_reference};
    for (std::uint32_t s = 0; s < slices.count; ++s) {
        const std::uint64_t index = t * slices.count + s;
        const GridCell& cell = cells.cells[index];
        if (cell.count == 0) continue;
        const bool are_all = cell.end - cell.begin == cell.count; // between the first and the last one
        if (!are_all) pick_slice(slices, s, sorted, cell.begin, cell.end, scratch.cell);
        const DepthArrays between = {sorted.light + cell.begin, sorted.low + cell.begin, sorted.high + cell.begin};
        write_cell(builder, cells.is_tree[index] != 0, are_all ? between : scratch.cell, cell.count, scratch.heap, to);
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
