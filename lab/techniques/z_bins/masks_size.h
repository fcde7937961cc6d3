#pragma once
// How large the masks of z_bins are.

#include <cstdint>

namespace manylights::lab {

/// Words of all tiles' masks at most: 4 GiB, more than which no binding can have.
constexpr std::uint64_t kMostMaskWords = std::uint64_t{1} << 30;

struct MasksSize {
    std::uint32_t tiles_x, tiles_y;
    std::uint32_t words;   ///< of a tile's mask
    std::uint32_t summary; ///< words that a summary of them has, a bit each
    std::uint64_t tiles() const { return std::uint64_t{tiles_x} * tiles_y; }
};

/// Throws InputError where the masks of all tiles have more than kMostMaskWords.
MasksSize masks_size(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size, std::uint32_t light_count);

} // namespace manylights::lab
