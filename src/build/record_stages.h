#pragma once
// The stages that work on all lights and tiles of a builder.

#include "src/build/builder.h"
#include "src/build/tasks.h"

#include <cstdint>

namespace manylights::detail {

// What a sample of the lights says about all of them. False: out of memory.
[[nodiscard]] bool take_sample(ManylightsBuilder& builder, const ManylightsLights& lights);

// After that: the sampled lights that a view sees; the tile size to begin with; and about how many tiles of a size the
// lights' pixels span, all together.
LightBlock sample_lights(ManylightsBuilder& builder, std::uint32_t view);
std::uint32_t first_tile_px(ManylightsBuilder& builder);
std::uint64_t estimate_tiles(ManylightsBuilder& builder, std::uint32_t tile_px);

// What the tasks that culled have found, for the caller. False: out of memory.
template <typename Task>
[[nodiscard]] bool finish_culling(ManylightsBuilder& builder, const Array<Task>& tasks) {
    builder.ignored = {};
    for (std::size_t i = 0; i < tasks.size(); ++i) builder.ignored = add_ignored(builder.ignored, tasks[i].ignored);
    for (std::uint32_t v = 0; v < builder.view_count; ++v)
        if (!list_visible(builder.views[v])) return false;
    return true;
}

// The planes of a view's columns and rows at its tile size. False: out of memory.
[[nodiscard]] bool make_narrow_views(ManylightsBuilder& builder, NarrowView (&views)[kMaxViews]);

// For windows: culls all lights and records them in their tiles. Not all records are there where they would be more
// than limit: kOverBudget, or kTooLarge where there is nothing coarser.
Fit collect_records(ManylightsBuilder& builder, const ManylightsLights& lights, std::uint64_t limit, bool has_to_do);

// For structures with depth slices: culls all lights and puts their boxes into the order of their depths; then deals
// them to their cells. False: out of memory.
[[nodiscard]] bool order_boxes(ManylightsBuilder& builder, const ManylightsLights& lights);
[[nodiscard]] bool deal_lights(ManylightsBuilder& builder);

// The work at one tile size, for windows and for structures with depth slices. has_to_do: no larger tiles are left,
// only what no buffer can hold stops it.
Fit arrange_windows(ManylightsBuilder& builder, const ManylightsLights& lights, bool has_to_do);
Fit arrange_cells(ManylightsBuilder& builder, const ManylightsLights& lights, bool has_to_do);

// Scratch of a task that works on tiles.
TileScratch tile_scratch(ManylightsBuilder& builder, std::uint32_t task);
std::size_t cell_room(const Cells& cells); // lights of the largest cell
std::size_t heap_room(const ManylightsBuilder& builder);

// Parts of write: these tiles' cells and references, or these blocks' cells, nodes and references.
void write_window_tiles(ManylightsBuilder& builder, std::uint32_t task, std::uint64_t begin, std::uint64_t end,
                        const ManylightsBuffers& buffers);
void write_cell_blocks(ManylightsBuilder& builder, std::uint32_t task, std::uint64_t begin, std::uint64_t end,
                       const ManylightsBuffers& buffers);

} // namespace manylights::detail
