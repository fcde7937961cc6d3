// Replays the depth windows that plan decided: headers, entries and references.
#include "src/build/record_stages.h"

#include <algorithm>
#include <cstring>

namespace manylights::detail {

namespace {

void write_tile(const ManylightsBuilder& builder, std::uint64_t index, const TileScratch& scratch, MlCell* cells,
                WindowReference* references) {
    const WindowTile& tile = builder.windows.tiles[index];
    if (tile.count == 0) return;
    const WindowReference* const ordered = order_tile(tile, list_runs(builder.records, index, scratch.runs), scratch);
    std::memcpy(cells + tile.first_entry, scratch.entries, ml_entry_cell_count(tile.form) * sizeof(MlCell));
    std::memcpy(references + tile.first_reference, ordered, tile.count * sizeof(WindowReference));
}

// Of the tiles [begin, end), all of one view: ascending, headers before entries.
void write_headers(const Windows& windows, const Grid& grid, const WindowView& view, std::uint64_t begin,
                   std::uint64_t end, MlCell* cells) {
    MlCell* out = cells + view.cell_offset + kHeaderCells * (begin - grid.tile_offset);
    for (std::uint64_t t = begin; t < end; ++t) {
        const WindowTile& tile = windows.tiles[t];
        *out++ = {tile.first_reference, tile.first_entry};
        *out++ = {tile.base_code, ml_pack_tile_form(tile.form)};
    }
}

} // namespace

void write_window_tiles(ManylightsBuilder& builder, std::uint32_t task, std::uint64_t begin, std::uint64_t end,
                        const ManylightsBuffers& buffers) {
    auto* cells = static_cast<MlCell*>(buffers.cells);
    auto* references = static_cast<WindowReference*>(buffers.references);
    const TileScratch scratch = tile_scratch(builder, task);
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        const std::uint64_t first = std::max(begin, grid.tile_offset);
        const std::uint64_t last = std::min(end, grid.tile_offset + grid.tile_count);
        if (first >= last) continue;
        write_headers(builder.windows, grid, builder.windows.views[v], first, last, cells);
        for (std::uint64_t t = first; t < last; ++t) write_tile(builder, t, scratch, cells, references);
    }
}

} // namespace manylights::detail
