#pragma once
// Depth windows: a tile's references are ordered by where their depths begin, and each depth slice of the tile names
// the run of them that can reach it. See <manylights/format.h> for the layout. All decisions are made on integer depth
// codes, by one function for producer and reader.
//
//   record   each light's depths in each of its tiles, narrowed             windows_narrow.cpp, tile_records.h
//   measure  each tile's classes and slices, so its exact size              windows_tile.cpp, windows_cut.cpp
//   write    each tile's records in order, and the windows over them        windows_tile.cpp, windows_write.cpp

#include "src/build/tile_records.h"
#include "src/format/layout.h"

#include <manylights/format.h>

#include <cstdint>

namespace manylights::detail {

constexpr std::uint64_t kHeaderCells = sizeof(MlTile) / sizeof(MlCell);

struct WindowTile {
    std::uint32_t first_reference;
    std::uint32_t first_entry; // cell
    std::uint32_t base_code;
    std::uint32_t count;
    std::uint32_t small_bits, small_count; // extents of so many bits belong to the first class
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

constexpr std::uint32_t kClassSlices = 256; // slices of the large class are numbered from here

// Scratch for the records of one tile.
struct TileScratch {
    RecordRun* runs;
    std::uint32_t* keys; // class and slice of the near end, those of the far end << 16
    std::uint32_t* places;
    WindowReference *described, *ordered;
    MlUint* entries; // kMostEntryWords
};
constexpr std::size_t kMostEntryWords = 4 * kClassSlices; // of two classes, and wide

struct Windows {
    WindowView views[kMaxViews];
    Array<RecordRun> runs;        // per task that works on tiles
    Array<std::uint32_t> scratch; // likewise
    Array<WindowTile> tiles;
    std::uint32_t tile_tasks = 1; // that cut and write the tiles
    std::uint32_t largest_tile = 0;
    std::uint64_t empty_tiles = 0, flat_tiles = 0;

    void use(const Allocator& allocator);
};

// Codes per unit of depth: a power of two that gives nearly all lights (all but one in 1,024) a near end below 2^18, so
// that depths to 64 times as far have codes of their own. exponents: how many near ends have which; bin b holds those
// in [2^(b - 127), 2^(b - 126)), bin 0 also all that are less.
float choose_depth_scale(const std::uint32_t (&exponents)[256]);

constexpr std::uint32_t kFlatReferences = 8; // up to so many, a table costs more than it saves
constexpr std::uint32_t kExtentLimits = 27;  // of 0 to 25 bits, and one that is counted with the last but one

// The extents of a tile's depth ranges. Of up to kFlatReferences only the largest matters, and the others are left out.
struct Extents {
    std::uint32_t base_code, last_code;
    std::uint32_t least, most;
    std::uint32_t counts[kExtentLimits];  // of those below 2^bits
    std::uint32_t largest[kExtentLimits]; // of those
};

// Chooses the classes and slices of a tile with count references, 1 at least. All of the result but where it begins.
WindowTile cut_tile(const Extents& extents, std::uint32_t count);
WindowTile measure_tile(const TileRuns& runs, std::uint32_t count, const TileScratch& scratch);

// A tile's references in order, in scratch; its entries are in scratch.entries.
const WindowReference* order_tile(const WindowTile& tile, const TileRuns& runs, const TileScratch& scratch);

// The slice of a depth code that is not below the tile's base.
inline std::uint32_t slice_of_code(const WindowTile& tile, std::uint32_t code) {
    return (code - tile.base_code) >> tile.form.slice_shift;
}

} // namespace manylights::detail
