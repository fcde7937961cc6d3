#include "src/build/record_stages.h"

#include <algorithm>

namespace manylights::detail {

namespace {

void lay_out_views(ManylightsBuilder& builder, std::uint32_t tile_px) {
    std::uint64_t tiles = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        lay_out(builder.grids[v], tile_px, builder.slices.count, tiles);
        tiles += builder.grids[v].tile_count;
    }
    builder.records.tile_count = tiles;
    builder.counts = {};
    builder.counts.views = builder.view_count;
    builder.counts.cells = tiles * (has_windows(builder) ? kHeaderCells : builder.slices.count);
    builder.counts.reference_words = reference_words(builder.settings.structure);
    if (!has_windows(builder))
        builder.counts.slice_edges = static_cast<std::uint64_t>(builder.view_count) * (builder.slices.count + 1);
}

bool is_coarsest(const ManylightsBuilder& builder) {
    return std::all_of(builder.grids, builder.grids + builder.view_count,
                       [](const Grid& grid) { return grid.tiles_x == 1 && grid.tiles_y == 1; });
}

// At the current tile size. Stops as soon as it is plain that the result will not fit, unless it has to do: then only
// what no buffer can hold stops it.
Fit arrange_tiles(ManylightsBuilder& builder, const ManylightsLights& lights, bool has_to_do) {
    if (builder.counts.cells > builder.most_elements) return Fit::kTooLarge;
    if (!has_to_do && !within_budget(builder)) return Fit::kOverBudget;
    return has_windows(builder) ? arrange_windows(builder, lights, has_to_do)
                                : arrange_cells(builder, lights, has_to_do);
}

void take_cell_stats(const ManylightsBuilder& builder, ManylightsStats& stats) {
    if (has_windows(builder)) {
        const Windows& windows = builder.windows;
        stats.cells = windows.tiles.size();
        stats.empty_cells = windows.empty_tiles;
        stats.list_cells = windows.flat_tiles;
        stats.tree_cells = stats.cells - windows.empty_tiles - windows.flat_tiles;
        return;
    }
    stats.cells = builder.counts.cells;
    const CellBlock& sums = builder.cells.blocks[builder.cells.blocks.size() - 1];
    stats.list_cells = sums.list_cells;
    stats.tree_cells = sums.tree_cells;
    stats.empty_cells = stats.cells - stats.list_cells - stats.tree_cells;
}

void take_stats(ManylightsBuilder& builder, bool over_budget) {
    ManylightsStats& stats = builder.stats;
    stats.bytes = total_bytes(sizes_of(builder.counts));
    stats.references = builder.counts.references;
    stats.nodes = builder.counts.nodes;
    take_cell_stats(builder, stats);
    stats.visible_lights = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) stats.visible_lights += builder.views[v].lights.count;
    stats.ignored_lights = builder.ignored.count;
    stats.first_ignored = builder.ignored.first;
    stats.tile_px = builder.grids[0].tile_px;
    stats.over_budget = over_budget ? 1 : 0;
}

} // namespace

bool within_budget(const ManylightsBuilder& builder) {
    return total_bytes(sizes_of(builder.counts)) <= builder.settings.max_bytes;
}

// Over budget is coarser, never wrong: the tiles double until the bytes fit, or one tile covers every image.
Outcome arrange(ManylightsBuilder& builder, const ManylightsLights& lights) {
    if (!take_sample(builder, lights)) return out_of_memory("lights");
    Fit fit = Fit::kTooLarge;
    for (std::uint32_t tile_px = first_tile_px(builder);; tile_px *= 2) {
        lay_out_views(builder, tile_px);
        const bool coarsest = is_coarsest(builder);
        fit = arrange_tiles(builder, lights, coarsest);
        if (coarsest || fit == Fit::kFits || fit == Fit::kOutOfMemory) break;
    }
    if (fit == Fit::kTooLarge)
        return {MANYLIGHTS_TOO_LARGE, "lights.count",
                "must give fewer than 2^32 references, nodes and cells with one tile per view", 0};
    if (fit == Fit::kOutOfMemory) return out_of_memory("cells");
    builder.task_count = has_windows(builder) ? builder.windows.tile_tasks : builder.cells.write_tasks;
    take_stats(builder, fit == Fit::kOverBudget);
    return {};
}

} // namespace manylights::detail
