#pragma once
// A cell's nodes.

#include "src/build/depth_codes.h"

#include <manylights/format.h>

#include <cstdint>

namespace manylights::detail {

// The depths of a cell's lights, in order, and where its references will be. Vectors may be read where the last one
// is.
struct CellLights {
    const DepthSpan* spans;
    std::uint32_t count;
    std::uint32_t first_reference;
    DepthCodes codes;
};

// Room behind the last span of a cell's lights.
constexpr std::uint32_t kSpanPadding = 64;

// A tree's depths, in scratch: 2 * leaf_count of the largest one and kSpanPadding more. 1 is the root, 2i and 2i + 1
// are the children of i, the leaves are the last leaf_count. What nothing reaches is (+inf, -inf).
struct NodeDepths {
    float low, high;
};

// Trees up to this size are written in whole vectors, which need room behind the last node: kSpanPadding nodes. Larger
// ones are written in ascending order, each node once.
constexpr std::uint32_t kSmallTreeNodes = 511;

// Both return the end of what they wrote.
MlNode* write_trees(const CellLights& lights, std::uint32_t leaf_size, NodeDepths* heap, MlNode* nodes);
MlNode* write_list(const CellLights& lights, MlNode* nodes);

} // namespace manylights::detail
