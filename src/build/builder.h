#pragma once
// What a builder keeps between calls: its settings, and the memory and results of the last plan.

#include "src/build/bin.h"
#include "src/build/cull.h"
#include "src/build/decide.h"
#include "src/build/settings.h"
#include "src/build/slices.h"
#include "src/build/sort.h"
#include "src/build/tasks.h"
#include "src/build/tree.h"
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

    manylights::detail::Array<manylights::detail::VisibleLight> listed; // of one view
    manylights::detail::Array<manylights::detail::SortItem> sort_items[2];
    manylights::detail::Array<manylights::detail::VisibleLight> sorted; // of all views, one after the other
    manylights::detail::Bins bins;
    manylights::detail::CellNodes nodes;
    manylights::detail::Windows windows;
    manylights::detail::Array<manylights::detail::DepthSpan> heaps; // one per task of write
    std::uint32_t task_count = 1;

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
std::uint64_t visible_lights(const ManylightsBuilder& builder); // of all views

// Culls and sorts to node offsets: coarsens until the result fits, and fills counts and stats.
Outcome arrange(ManylightsBuilder& builder, const ManylightsLights& lights);

// Windows: the tile size to begin with, after a sample was taken, and the work at one tile size. has_to_do: no larger
// ones are left, only what no buffer can hold stops it.
std::uint32_t first_tile_px(ManylightsBuilder& builder);
Fit arrange_windows(ManylightsBuilder& builder, const ManylightsLights& lights, bool has_to_do);

// Windows: headers, entries and references of these tiles, a part of write. Each task has scratch of its own.
void write_window_tiles(ManylightsBuilder& builder, std::uint32_t task, std::uint64_t begin, std::uint64_t end,
                        const ManylightsBuffers& buffers);

// The buffers of the last plan, into the caller's memory.
void write_buffers(ManylightsBuilder& builder, const ManylightsBuffers& buffers);

} // namespace manylights::detail
