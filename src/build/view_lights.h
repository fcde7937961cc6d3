#pragma once
// The lights of a view after culling: structure of arrays, in blocks. A block of the caller's lights leaves its visible
// ones, ascending, at the begin of its own room, so that blocks are independent of each other.

#include "src/build/array.h"
#include "src/build/lanes.h"

#include <cstdint>
#include <initializer_list>

namespace manylights::detail {

constexpr std::uint32_t kBlockLights = 4096;
constexpr std::uint32_t kBlockRoom = kBlockLights + kLanePadding; // no block writes into its neighbour's

inline std::uint64_t block_count_for(std::uint64_t lights) { return (lights + kBlockLights - 1) / kBlockLights; }

// One block's arrays.
struct LightBlock {
    float *x, *y, *depth, *radius;      // a sphere that holds the light's: along view x and y, depth, culling radius
    std::uint32_t* index;               // the caller's
    std::uint32_t *pixels_x, *pixels_y; // first | last << 16
    std::uint32_t count;
};

struct ViewLights {
    Array<float> x, y, depth, radius;
    Array<std::uint32_t> index, pixels_x, pixels_y;
    Array<std::uint32_t> counts; // per block
    std::uint64_t count = 0;     // of all blocks

    void use(const Allocator& allocator);
    [[nodiscard]] bool resize(std::uint64_t block_count);
    [[nodiscard]] bool resize_indices(std::uint64_t block_count); // where nothing else is kept
    LightBlock block(std::uint64_t index_of_block);
    std::uint64_t block_count() const { return counts.size(); }
};

inline void ViewLights::use(const Allocator& allocator) {
    for (Array<float>* array : {&x, &y, &depth, &radius}) array->use(allocator);
    for (Array<std::uint32_t>* array : {&index, &pixels_x, &pixels_y, &counts}) array->use(allocator);
}

inline bool ViewLights::resize_indices(std::uint64_t block_count) {
    return index.resize(block_count * kBlockRoom) && counts.resize(block_count);
}

inline bool ViewLights::resize(std::uint64_t block_count) {
    const std::uint64_t room = block_count * kBlockRoom;
    for (Array<float>* array : {&x, &y, &depth, &radius})
        if (!array->resize(room)) return false;
    return pixels_x.resize(room) && pixels_y.resize(room) && resize_indices(block_count);
}

inline LightBlock ViewLights::block(std::uint64_t index_of_block) {
    const std::uint64_t at = index_of_block * kBlockRoom;
    return {x.data() + at,     y.data() + at,        depth.data() + at,    radius.data() + at,
            index.data() + at, pixels_x.data() + at, pixels_y.data() + at, counts[index_of_block]};
}

} // namespace manylights::detail
