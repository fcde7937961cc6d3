#include "reference/paper/radix_sort.h"

#include <utility>

namespace manylights::paper {

const SortPair* RadixSort::sort(std::size_t count) {
    SortPair* from = pairs_.require(count);
    SortPair* to = other_.require(count);
    std::uint32_t starts[4][256] = {};
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t key = from[i].key;
        ++starts[0][key & 255];
        ++starts[1][(key >> 8) & 255];
        ++starts[2][(key >> 16) & 255];
        ++starts[3][key >> 24];
    }
    for (int pass = 0; pass < 4; ++pass) {
        std::uint32_t sum = 0;
        for (std::uint32_t& start : starts[pass]) sum += std::exchange(start, sum);
        const int shift = 8 * pass;
        for (std::size_t i = 0; i < count; ++i) to[starts[pass][(from[i].key >> shift) & 255]++] = from[i];
        std::swap(from, to);
    }
    return from;
}

} // namespace manylights::paper
