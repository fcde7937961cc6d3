#pragma once
// A light in a view, as the structures with depth slices need it.

#include "src/build/slices.h"
#include "src/build/view_lights.h"

#include <cstdint>

namespace manylights::detail {

struct VisibleLight {
    std::uint32_t index; // the caller's
    float min_depth;
    float max_depth;
    float center_depth;
    std::uint16_t first_px[2], last_px[2]; // x, y
    std::uint8_t first_slice, last_slice;
};

// Of the light at this position in its block.
VisibleLight visible_light(const LightBlock& lights, std::uint32_t at, const Slices& slices);

} // namespace manylights::detail
