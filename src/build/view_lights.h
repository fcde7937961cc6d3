#pragma once
// The lights of a view after culling, in blocks. A block of the caller's lights leaves its visible ones, ascending, at
// the begin of its own room, so that blocks are independent of each other.

#include "src/build/array.h"
#include "src/build/lanes.h"

#include <cstdint>

namespace manylights::detail {

constexpr std::uint32_t kBlockLights = 4096;
constexpr std::uint32_t kBlockRoom = kBlockLights + kLanePadding; // no block writes into its neighbour's

inline std::uint64_t block_count_for(std::uint64_t lights) { return (lights + kBlockLights - 1) / kBlockLights; }

// One block's visible lights: structure of arrays.
struct LightBlock {
    float *x, *y, *depth, *radius;      // a sphere that holds the light's: along view x and y, depth, culling radius
    std::uint32_t* index;               // the caller's
    std::uint32_t *pixels_x, *pixels_y; // first | last << 16
    std::uint32_t count;
};

// A block without lights in this memory: kBlockFloats, kBlockPixels, and kBlockRoom for the indices.
constexpr std::size_t kBlockFloats = 4 * std::size_t{kBlockRoom};
constexpr std::size_t kBlockPixels = 2 * std::size_t{kBlockRoom};
inline LightBlock lay_out_block(float* floats, std::uint32_t* pixels, std::uint32_t* index) {
    constexpr std::size_t kRoom = kBlockRoom;
    return {floats, floats + kRoom, floats + 2 * kRoom, floats + 3 * kRoom, index, pixels, pixels + kRoom, 0};
}

// What stays of a view's lights: the indices of the visible ones, in their blocks' rooms.
struct ViewLights {
    Array<std::uint32_t> index;
    Array<std::uint32_t> counts; // per block
    std::uint64_t count = 0;     // of all blocks

    [[nodiscard]] bool resize(std::uint64_t block_count) {
        return index.resize(block_count * kBlockRoom) && counts.resize(block_count);
    }
};

} // namespace manylights::detail
