#pragma once
// The tiles and cells of a view.

#include "src/format/layout.h"

#include <cstdint>

namespace manylights::detail {

struct Grid {
    std::uint32_t width, height; // pixels
    std::uint32_t tile_px;
    std::uint32_t tiles_x, tiles_y;
    std::uint32_t slice_count;
    std::uint64_t tile_offset; // of the first tile, counting the tiles of all earlier views
    std::uint64_t tile_count;

    // Likewise of cells: tile x fastest, then tile y, then slice.
    std::uint64_t cell_offset() const { return tile_offset * slice_count; }
    std::uint64_t cell_count() const { return tile_count * slice_count; }
};

inline void lay_out(Grid& grid, std::uint32_t tile_px, std::uint32_t slice_count, std::uint64_t tile_offset) {
    grid.tile_px = tile_px;
    grid.tiles_x = divide_up(grid.width, tile_px);
    grid.tiles_y = divide_up(grid.height, tile_px);
    grid.slice_count = slice_count;
    grid.tile_offset = tile_offset;
    grid.tile_count = static_cast<std::uint64_t>(grid.tiles_x) * grid.tiles_y;
}

} // namespace manylights::detail
