#include "src/build/builder.h"
#include "src/build/windows_plan.h"

#include <algorithm>

namespace manylights::detail {

namespace {

bool sort_views(ManylightsBuilder& builder) {
    builder.sorted.clear();
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        builder.grids[v].first_light = builder.sorted.size();
        if (!list_lights(builder.views[v].lights, builder.slices, builder.listed)) return false;
        if (!append_sorted(builder.listed, builder.sort_items, builder.sorted)) return false;
        builder.grids[v].end_light = builder.sorted.size();
    }
    return true;
}

void lay_out_views(ManylightsBuilder& builder, std::uint32_t tile_px) {
    std::uint64_t cell_offset = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        lay_out(builder.grids[v], tile_px, builder.slices.count, cell_offset);
        cell_offset += builder.grids[v].cell_count;
    }
    builder.counts = {};
    builder.counts.views = builder.view_count;
    builder.counts.cells = cell_offset;
    builder.counts.reference_words = reference_words(builder.settings.structure);
    if (!has_windows(builder))
        builder.counts.slice_edges = static_cast<std::uint64_t>(builder.view_count) * (builder.slices.count + 1);
}

bool is_coarsest(const ManylightsBuilder& builder) {
    return std::all_of(builder.grids, builder.grids + builder.view_count,
                       [](const Grid& grid) { return grid.tiles_x == 1 && grid.tiles_y == 1; });
}

// Counts and bins at the current tile size. Stops as soon as it is plain that the result will not fit, unless it has
// to do: then only what no buffer can hold stops it.
Fit bin_views(ManylightsBuilder& builder, bool has_to_do) {
    Counts& counts = builder.counts;
    const std::uint64_t most = builder.most_elements;
    if (counts.cells > most) return Fit::kTooLarge;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        counts.references += count_references(builder.grids[v], builder.sorted.data(), most);
        if (counts.references > most) return Fit::kTooLarge;
    }
    if (!has_to_do && !within_budget(builder)) return Fit::kOverBudget;

    if (!fill_bins(builder.grids, builder.view_count, builder.sorted.data(), counts.references, builder.bins) ||
        !decide_cells(builder.settings, builder.slices, builder.grids, builder.views, builder.view_count,
                      builder.sorted.data(), builder.bins, builder.nodes))
        return Fit::kOutOfMemory;
    counts.nodes = builder.nodes.offsets[counts.cells];
    if (counts.nodes > most) return Fit::kTooLarge;
    return within_budget(builder) ? Fit::kFits : Fit::kOverBudget;
}

// Tasks of write: enough work for each to pay for its start.
bool prepare_tasks(ManylightsBuilder& builder) {
    if (has_windows(builder)) {
        builder.task_count = builder.windows.tile_tasks;
        return true;
    }
    constexpr std::uint64_t kWorkPerTask = 1024; // cells, nodes and references
    const Counts& counts = builder.counts;
    const std::uint64_t worthwhile = (counts.cells + counts.nodes + counts.references) / kWorkPerTask + 1;
    builder.task_count = task_count_for(builder.settings, worthwhile, 1);
    const std::size_t heap_size = 2 * static_cast<std::size_t>(builder.nodes.largest_tree_leaves);
    return builder.heaps.resize(heap_size * builder.task_count);
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
    stats.empty_cells = builder.nodes.empty_cells;
    stats.list_cells = builder.nodes.list_cells;
    stats.tree_cells = builder.nodes.tree_cells;
}

void take_stats(ManylightsBuilder& builder, bool over_budget) {
    ManylightsStats& stats = builder.stats;
    stats.bytes = total_bytes(sizes_of(builder.counts));
    stats.references = builder.counts.references;
    stats.nodes = builder.counts.nodes;
    take_cell_stats(builder, stats);
    stats.visible_lights = visible_lights(builder);
    stats.ignored_lights = builder.ignored.count;
    stats.first_ignored = builder.ignored.first;
    stats.tile_px = builder.grids[0].tile_px;
    stats.over_budget = over_budget ? 1 : 0;
}

} // namespace

bool within_budget(const ManylightsBuilder& builder) {
    return total_bytes(sizes_of(builder.counts)) <= builder.settings.max_bytes;
}

std::uint64_t visible_lights(const ManylightsBuilder& builder) {
    std::uint64_t sum = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) sum += builder.views[v].lights.count;
    return sum;
}

namespace {

// What comes before the work at a tile size.
bool prepare(ManylightsBuilder& builder, const ManylightsLights& lights) {
    if (has_windows(builder)) return take_sample(builder, lights);
    return cull_lights(lights, builder.settings, builder.views, builder.view_count, builder.ignored) &&
           sort_views(builder);
}

} // namespace

// Over budget is coarser, never wrong: the tiles double until the bytes fit, or one tile covers every image.
Outcome arrange(ManylightsBuilder& builder, const ManylightsLights& lights) {
    if (!prepare(builder, lights)) return out_of_memory("lights");
    Fit fit = Fit::kTooLarge;
    if (has_windows(builder) || visible_lights(builder) <= builder.most_elements) {
        const std::uint32_t first_px = has_windows(builder) ? first_tile_px(builder) : builder.settings.tile_px;
        for (std::uint32_t tile_px = first_px;; tile_px *= 2) {
            lay_out_views(builder, tile_px);
            const bool coarsest = is_coarsest(builder);
            fit = has_windows(builder) ? arrange_windows(builder, lights, coarsest) : bin_views(builder, coarsest);
            if (coarsest || fit == Fit::kFits || fit == Fit::kOutOfMemory) break;
        }
    }
    if (fit == Fit::kTooLarge)
        return {MANYLIGHTS_TOO_LARGE, "lights.count",
                "must give fewer than 2^32 references, nodes and cells with one tile per view", 0};
    if (fit == Fit::kOutOfMemory || !prepare_tasks(builder)) return out_of_memory("cells");
    take_stats(builder, fit == Fit::kOverBudget);
    return {};
}

} // namespace manylights::detail
