#pragma once
// Square tiles of an image, for techniques that build on the device. Those at the right and the lower edge may be cut.

#include "lab/gpu/commands.h"

#include <cstdint>

namespace manylights::lab {

/// What the shaders know of it; tiles are numbered row by row.
struct TileGrid {
    std::uint32_t tile_size; ///< pixels
    std::uint32_t tiles_x, tiles_y;

    std::uint32_t tile_count() const { return tiles_x * tiles_y; }
};

inline TileGrid tile_grid(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size) {
    return {tile_size, gpu::group_count(width, tile_size), gpu::group_count(height, tile_size)};
}

} // namespace manylights::lab
