#pragma once
// The stages of depth windows that work on all lights of a builder.

#include "src/build/builder.h"

#include <cstdint>

namespace manylights::detail {

// False: out of memory, as below.
[[nodiscard]] bool take_sample(ManylightsBuilder& builder, const ManylightsLights& lights);

// About how many tiles of this size the lights' pixels span, all together.
std::uint64_t estimate_tiles(ManylightsBuilder& builder, std::uint32_t tile_px);

// The planes of a view's columns and rows at its tile size.
[[nodiscard]] bool make_narrow_views(ManylightsBuilder& builder, NarrowView (&views)[kMaxViews]);

// Culls all lights and records them in their tiles. kOverBudget: more records than limit, and not all of them are
// there.
Fit collect_records(ManylightsBuilder& builder, const ManylightsLights& lights, std::uint64_t estimate,
                    std::uint64_t limit);

} // namespace manylights::detail
