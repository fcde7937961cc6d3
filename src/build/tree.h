#pragma once
// A cell's nodes, written once each and in ascending order: the destination may be write-combined memory.

#include <manylights/format.h>

#include <cstdint>

namespace manylights::detail {

// Depths that a node's lights reach.
struct DepthSpan {
    float low, high;
};

// The depths of a cell's lights, in order, and where its references will be.
struct CellLights {
    const float *low, *high;
    std::uint32_t count;
    std::uint32_t first_reference;
};

// heap: scratch for 2 * leaf_count spans of the largest tree. Both return the end of what they wrote.
MlNode* write_trees(const CellLights& lights, std::uint32_t leaf_size, DepthSpan* heap, MlNode* nodes);
MlNode* write_list(const CellLights& lights, MlNode* nodes);

} // namespace manylights::detail
