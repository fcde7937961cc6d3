#pragma once
// Sorting by view depth: least significant digit first, four passes of 8 bits (TLT section 3.2 names a radix sort).

#include "reference/paper/flat_array.h"

#include <bit>
#include <cstdint>

namespace manylights::paper {

struct SortPair {
    std::uint32_t key, rank;
};

/// A key whose unsigned order is the float's order, so that lights behind the camera come first.
inline std::uint32_t sort_key(float depth) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(depth);
    return bits ^ ((bits >> 31) != 0 ? 0xFFFFFFFFu : 0x80000000u);
}

class RadixSort {
  public:
    /// Where the caller puts `count` pairs before sort(count).
    SortPair* pairs(std::size_t count) { return pairs_.require(count); }
    /// Sorts them, stably; the result stays valid until the next call of pairs.
    const SortPair* sort(std::size_t count);

  private:
    FlatArray<SortPair> pairs_, other_;
};

} // namespace manylights::paper
