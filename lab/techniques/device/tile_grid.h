#pragma once
// Tiles of an image, for techniques that build on the device: square ones of a given size, of which those at the right
// and the lower edge may be cut, or a given number of them, which then may differ by a pixel.

#include "lab/gpu/commands.h"

#include <cstdint>

namespace manylights::lab {

/// What the shaders know of it; tiles are numbered row by row. Of n tiles along an axis, tile i begins at pixel
/// ceil(i * span / n), and a pixel p is in tile floor(p * n / span). Of more tiles than pixels some are empty.
struct TileGrid {
    std::uint32_t tiles_x, tiles_y;
    std::uint32_t span_x, span_y; ///< pixels that the tiles would cover, were none of them cut

    std::uint32_t tile_count() const { return tiles_x * tiles_y; }
};

/// As many as may be asked for: products with up to 2^16 pixels stay within 32 bits, and every device can draw into an
/// image with a pixel per tile.
constexpr std::uint32_t kMostTilesOfAxis = 4096;

inline TileGrid tile_grid(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size) {
    const std::uint32_t tiles_x = gpu::group_count(width, tile_size), tiles_y = gpu::group_count(height, tile_size);
    return {tiles_x, tiles_y, tiles_x * tile_size, tiles_y * tile_size};
}

inline TileGrid tile_grid_of_counts(std::uint32_t width, std::uint32_t height, std::uint32_t tiles_x,
                                    std::uint32_t tiles_y) {
    return {tiles_x, tiles_y, width, height};
}

} // namespace manylights::lab
