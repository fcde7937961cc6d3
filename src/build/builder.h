#pragma once
// What a builder keeps between calls: its settings, and the memory and results of the last plan.

#include "src/build/cells.h"
#include "src/build/cull.h"
#include "src/build/settings.h"
#include "src/build/slices.h"
#include "src/build/windows.h"
#include "src/format/layout.h"

struct ManylightsBuilder {
    manylights::detail::Settings settings;
    manylights::detail::Slices slices;

    manylights::detail::View views[manylights::detail::kMaxViews];
    manylights::detail::Grid grids[manylights::detail::kMaxViews];
    std::uint32_t view_count = 0;
    bool planned = false;
    std::uint64_t most_elements = UINT32_MAX; // of references, nodes and cells: their offsets have 32 bits

    manylights::detail::TileRecords records;
    manylights::detail::Windows windows; // of one kind of structure
    manylights::detail::Cells cells;     // of the others
    std::uint32_t task_count = 1;        // of write

    manylights::detail::Array<std::uint32_t> validate_marks;

    manylights::detail::Ignored ignored{};
    manylights::detail::Counts counts{};
    ManylightsStats stats{};
};

namespace manylights::detail {

inline bool has_windows(const ManylightsBuilder& builder) {
    return builder.settings.structure == MANYLIGHTS_STRUCTURE_WINDOWS;
}

// What came of a tile size.
enum class Fit { kFits, kOverBudget, kTooLarge, kOutOfMemory };

bool within_budget(const ManylightsBuilder& builder);

// Culls and sorts to node offsets: coarsens until the result fits, and fills counts and stats.
Outcome arrange(ManylightsBuilder& builder, const ManylightsLights& lights);

// The buffers of the last plan, into the caller's memory.
void write_buffers(ManylightsBuilder& builder, const ManylightsBuffers& buffers);

} // namespace manylights::detail
