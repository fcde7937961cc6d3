#pragma once
// Tiles of windows made by hand from plain integers, and the rule of the format read plainly: what a point may be
// handed.

#include <manylights/format.h>

#include <vector>

namespace manylights::test {

/// A light in a tile: its depth codes and the steps of its rectangle, ends included.
struct MadeReference {
    MlUint light;
    MlUint low, high;
    MlUint x0 = 0, x1 = 15, y0 = 0, y1 = 15;
};

/// A tile and how it is to be written. Empty where it has no references.
struct MadeTile {
    MlUint base_code = 0;
    MlTileForm form{};
    std::vector<MadeReference> small, large;
};

/// In the order of the format: by the slice of the near end. The order of append_tiles and candidates alike.
std::vector<MadeReference> in_slice_order(const MadeTile& tile, std::vector<MadeReference> references);

/// The cells and the references of a view with these tiles, behind what is there already.
void append_tiles(const std::vector<MadeTile>& tiles, std::vector<MlCell>& cells, std::vector<MlUint>& references);

/// The lights that the query must hand out in a tile for a depth code at (x, y), in order, by divisions and loops.
std::vector<MlUint> candidates(const MadeTile& tile, MlUint code, MlUint x, MlUint y);

/// How many references the query must compare for a depth code, found or not.
MlUint compared(const MadeTile& tile, MlUint code);

/// The lights that hold the depth code and the place, in order: none of them may be missing among the candidates.
std::vector<MlUint> holders(const MadeTile& tile, MlUint code, MlUint x, MlUint y);

/// A view of one row of tiles, 16 pixels wide and high, so that a pixel is a step.
MlView windows_view(MlUint tile_count, MlUint cell_count, float depth_scale);

} // namespace manylights::test
