#pragma once
// The depth slices: a table of edges that both sides of the interface decide by.

#include "src/format/layout.h"

#include <cstdint>

namespace manylights::detail {

struct Slices {
    std::uint32_t count;
    float edges[kMaxSlices + 1]; // slice s holds the depths in [edges[s], edges[s + 1])
    float scale;                 // the shader's first guess: floor(log2(depth) * scale + bias)
    float bias;
};

// Slice 0 is [0, near); slices 1 to count - 1 divide [near, far) exponentially, and the last one is open to +inf.
Slices make_slices(std::uint32_t count, float near_edge, float far_edge);

// The slice of a depth, by the rule of ml_slice in <manylights/query.h>. Depths below 0 belong to slice 0.
std::uint32_t slice_of(const Slices& slices, float depth);

} // namespace manylights::detail
