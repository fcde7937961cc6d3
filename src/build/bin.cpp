#include "src/build/bin.h"

#include "src/format/layout.h"

namespace manylights::detail {

namespace {

struct TileBox {
    std::uint32_t x0, x1, y0, y1, s0, s1; // inclusive

    std::uint64_t volume() const { return static_cast<std::uint64_t>(x1 - x0 + 1) * (y1 - y0 + 1) * (s1 - s0 + 1); }
};

// The same function counts and fills: one rule decides, so the fill cannot overrun what was counted.
TileBox box_of(const Grid& grid, const VisibleLight& light) {
    return {light.first_px[0] / grid.tile_px,
            light.last_px[0] / grid.tile_px,
            light.first_px[1] / grid.tile_px,
            light.last_px[1] / grid.tile_px,
            light.first_slice,
            light.last_slice};
}

template <typename Visit>
void for_each_cell(const Grid& grid, const TileBox& box, Visit visit) {
    for (std::uint32_t s = box.s0; s <= box.s1; ++s) {
        for (std::uint32_t y = box.y0; y <= box.y1; ++y) {
            const std::uint64_t row =
                grid.cell_offset + (static_cast<std::uint64_t>(s) * grid.tiles_y + y) * grid.tiles_x;
            for (std::uint32_t x = box.x0; x <= box.x1; ++x) visit(row + x);
        }
    }
}

} // namespace

void lay_out(Grid& grid, std::uint32_t tile_px, std::uint32_t slice_count, std::uint64_t cell_offset) {
    grid.tile_px = tile_px;
    grid.tiles_x = divide_up(grid.width, tile_px);
    grid.tiles_y = divide_up(grid.height, tile_px);
    grid.slice_count = slice_count;
    grid.cell_offset = cell_offset;
    grid.cell_count = static_cast<std::uint64_t>(grid.tiles_x) * grid.tiles_y * slice_count;
}

std::uint64_t count_references(const Grid& grid, const VisibleLight* sorted, std::uint64_t limit) {
    std::uint64_t sum = 0;
    for (std::uint64_t i = grid.first_light; i < grid.end_light && sum <= limit; ++i)
        sum += box_of(grid, sorted[i]).volume();
    return sum;
}

// offsets has two more elements than there are cells. A cell's count goes two places behind it; the prefix sum turns
// the place behind each cell into its begin; and filling moves that place to the cell's end, which is the begin of the
// next one. In the end each cell's begin stands in its own place.
bool fill_bins(const Grid* grids, std::uint32_t grid_count, const VisibleLight* sorted, std::uint64_t reference_count,
               Bins& bins) {
    std::uint64_t cells = 0;
    for (std::uint32_t g = 0; g < grid_count; ++g) cells += grids[g].cell_count;
    if (!bins.offsets.resize(cells + 2) || !bins.ranks.resize(reference_count)) return false;
    bins.offsets.fill_zero();
    std::uint32_t* offsets = bins.offsets.data();
    std::uint32_t* ranks = bins.ranks.data();

    for (std::uint32_t g = 0; g < grid_count; ++g)
        for (std::uint64_t i = grids[g].first_light; i < grids[g].end_light; ++i)
            for_each_cell(grids[g], box_of(grids[g], sorted[i]), [&](std::uint64_t cell) { ++offsets[cell + 2]; });
    for (std::uint64_t cell = 0; cell < cells; ++cell) offsets[cell + 2] += offsets[cell + 1];
    for (std::uint32_t g = 0; g < grid_count; ++g)
        for (std::uint64_t i = grids[g].first_light; i < grids[g].end_light; ++i)
            for_each_cell(grids[g], box_of(grids[g], sorted[i]),
                          [&](std::uint64_t cell) { ranks[offsets[cell + 1]++] = static_cast<std::uint32_t>(i); });
    return true;
}

} // namespace manylights::detail
