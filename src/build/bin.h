#pragma once
// Lights into cells: count, prefix sum, fill. A light goes to every cell of the box that its pixel rectangle and its
// slice range span (box binning, as in Tiled Light Trees, section 3.2).

#include "src/build/visible_light.h"

#include <cstdint>

namespace manylights::detail {

// The cells of a view.
struct Grid {
    std::uint32_t width, height; // pixels
    std::uint32_t tile_px;
    std::uint32_t tiles_x, tiles_y;
    std::uint32_t slice_count;
    std::uint64_t cell_offset; // of the first one, counting the cells of all earlier views
    std::uint64_t cell_count;
    std::uint64_t first_light, end_light; // the view's lights among the sorted ones
};

void lay_out(Grid& grid, std::uint32_t tile_px, std::uint32_t slice_count, std::uint64_t cell_offset);

// (light, cell) pairs of the view; stops counting once there are more than limit.
std::uint64_t count_references(const Grid& grid, const VisibleLight* sorted, std::uint64_t limit);

// A cell's references are [begin(c), begin(c + 1)) of all of them; each is a position among the sorted lights, and
// they ascend, so a cell's lights are ordered by depth.
struct Bins {
    Array<std::uint32_t> offsets; // cell count + 2, see fill_bins
    Array<std::uint32_t> ranks;

    std::uint32_t begin(std::uint64_t cell) const { return offsets[cell]; }
    std::uint32_t count(std::uint64_t cell) const { return offsets[cell + 1] - offsets[cell]; }
};

// reference_count: the sum of count_references over the grids; it and the cells fit 32 bits.
[[nodiscard]] bool fill_bins(const Grid* grids, std::uint32_t grid_count, const VisibleLight* sorted,
                             std::uint64_t reference_count, Bins& bins);

} // namespace manylights::detail
