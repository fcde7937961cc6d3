#pragma once
// Depth windows: a tile's references are ordered by where their depths begin, and each depth slice of the tile names
// the run of them that can reach it. See <manylights/format.h> for the layout. All decisions are made on integer depth
// codes, by one function for producer and reader.

#include "src/build/bin.h"
#include "src/build/cull.h"
#include "src/build/narrow.h"
#include "src/format/layout.h"

#include <manylights/format.h>

#include <cstdint>

namespace manylights::detail {

constexpr std::uint64_t kHeaderCells = sizeof(MlTile) / sizeof(MlCell);

// One light in one tile, narrowed. Decided once, in plan; write replays it.
struct WindowRecord {
    std::uint32_t light;     // the caller's index
    std::uint32_t near_bits; // depth code 24 bits, x0 4 bits, x1 4 bits
    std::uint32_t far_bits;  // depth code 24 bits, y0 4 bits, y1 4 bits
    std::uint32_t tile;      // of all views

    std::uint32_t near_code() const { return near_bits & ML_DEPTH_CODE_MAX; }
    std::uint32_t far_code() const { return far_bits & ML_DEPTH_CODE_MAX; }
    std::uint32_t extent() const { return far_code() - near_code(); }
};

// How a light meets a column or a row of tiles.
struct TileCut {
    WedgeCut cut;
    std::uint32_t tile;  // along the axis
    std::uint32_t steps; // of the tile, that the light's pixels span: first and last, 4 bits each
};

struct WindowTile {
    std::uint32_t first_reference;
    std::uint32_t first_entry; // cell
    std::uint32_t base_code;
    std::uint32_t small_count; // references of the first class
    MlTileForm form;
};

struct WindowView {
    float depth_scale;
    std::uint64_t cell_offset, cell_count; // headers and entries
};

struct Windows {
    WindowView views[kMaxViews];
    Array<TileWedge> wedges;      // of one view: its columns, then its rows
    Array<TileCut> rows;          // of one light
    Array<std::uint32_t> offsets; // tile count + 2, as in fill_bins: the references of tile t begin at offsets[t]
    Array<WindowRecord> found;    // in order of views and lights; in the end by tile, as they are written
    Array<WindowRecord> by_tile;  // the same, by tile, in order of lights
    Array<WindowTile> tiles;
    std::uint64_t empty_tiles, flat_tiles;

    void use(const Allocator& allocator);
};

// Codes per unit of depth: a power of two that gives nearly all lights (all but one in 1,024) a near end below 2^18, so
// that depths to 64 times as far have codes of their own.
float choose_depth_scale(const VisibleLight* lights, std::uint64_t count);

// Narrows every light of the views to every tile of its box, and puts the records into tile order. fits is false, and
// the rest is not done, where there are more than limit records. False: out of memory.
[[nodiscard]] bool bin_windows(const Grid* grids, const View* views, std::uint32_t view_count, std::uint64_t limit,
                               Windows& windows, bool& fits);

// Chooses the classes and slices of a tile and puts its records into their final order, from one array to the other.
// All of the result but where it begins. count is at least 1.
WindowTile cut_tile(const WindowRecord* records, std::uint32_t count, WindowRecord* ordered);

// The slice of a depth code that is not below the tile's base.
inline std::uint32_t slice_of_code(const WindowTile& tile, std::uint32_t code) {
    return (code - tile.base_code) >> tile.form.slice_shift;
}

} // namespace manylights::detail
