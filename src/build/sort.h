#pragma once
// Lights in order of depth, nearest first: what makes the leaves of a light tree small.

#include "src/build/visible_light.h"

#include <cstdint>

namespace manylights::detail {

// One (key, position) pair of the radix sort.
struct SortItem {
    std::uint32_t key;
    std::uint32_t position;
};

// Maps a float to an integer in the same order. The raw bits of negative floats sort above all positive ones and
// backwards among themselves: flip all of their bits, and the sign of the others.
std::uint32_t sortable_key(float value);

// All of a view's, in the order of the caller.
[[nodiscard]] bool list_lights(ViewLights& view, const Slices& slices, Array<VisibleLight>& lights);

// Appends the lights to sorted, by ascending centre depth; equal depths keep their order. The items are scratch.
[[nodiscard]] bool append_sorted(const Array<VisibleLight>& lights, Array<SortItem> (&items)[2],
                                 Array<VisibleLight>& sorted);

} // namespace manylights::detail
