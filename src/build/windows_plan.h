#pragma once
// The stages of depth windows that work on all lights of a builder.

#include "src/build/builder.h"

#include <cstdint>

namespace manylights::detail {

// The least i in [0, count] with before(i) >= target; before ascends.
template <typename Before>
std::uint64_t first_with(std::uint64_t count, std::uint64_t target, const Before& before) {
    std::uint64_t low = 0;
    std::uint64_t high = count;
    while (low < high) {
        const std::uint64_t middle = (low + high) / 2;
        if (before(middle) < target)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

// Each light's tiles, and buckets for as many records per tile. spanned: all of them. False: out of memory, all three.
[[nodiscard]] bool span_lights(ManylightsBuilder& builder, std::uint64_t tile_count, std::uint64_t& spanned);

// The records, in the buckets. spanned fits 32 bits.
[[nodiscard]] bool narrow_lights(ManylightsBuilder& builder, std::uint64_t tile_count, std::uint64_t spanned);

// Decides how many tasks work on tiles, and makes scratch for each.
[[nodiscard]] bool prepare_tile_tasks(ManylightsBuilder& builder, std::uint64_t tile_count);

} // namespace manylights::detail
