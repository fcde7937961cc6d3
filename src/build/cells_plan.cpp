// The cells of all tiles: their lights, whether they hold a list or a tree, and the exact counts of what write replays.
#include "src/build/record_stages.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace manylights::detail {

namespace {

constexpr std::size_t kScratchWords = 5; // per record, see CellScratch

// What each tile costs beside its records.
std::uint64_t work_before(const ManylightsBuilder& builder, std::uint64_t tile) {
    const Cells& cells = builder.cells;
    const std::uint64_t per_tile = 32 + builder.slices.count;
    const std::uint64_t records =
        tile < builder.records.tile_count ? cells.tiles[tile].first_record : builder.records.count;
    return tile * per_tile + records;
}

// Puts the tile's records behind those of the tile before.
void place_records(ManylightsBuilder& builder) {
    Cells& cells = builder.cells;
    cells.largest_tile = 0;
    std::uint32_t before = 0;
    for (std::uint64_t t = 0; t < builder.records.tile_count; ++t) {
        const std::uint32_t count = tile_record_count(builder.records, t);
        cells.tiles[t] = {before, count, 0, 0, 0, 0, 0, 0};
        cells.largest_tile = std::max(cells.largest_tile, count);
        before += count;
    }
}

std::size_t heap_room(const ManylightsBuilder& builder) {
    const std::uint32_t lights = std::clamp(builder.cells.largest_tile, 1u, kMaxTreeLights);
    return 2 * static_cast<std::size_t>(tree_shape(lights, builder.settings.leaf_size).leaf_count);
}

// No more tasks than the largest tile leaves work for: each has room for that one.
bool prepare_tasks(ManylightsBuilder& builder) {
    constexpr std::uint64_t kWorkPerTask = 1024; // records and cells
    Cells& cells = builder.cells;
    const std::uint64_t work = work_before(builder, builder.records.tile_count);
    const std::uint64_t useful = work / std::max(cells.largest_tile, 1u) + 1;
    cells.tile_tasks = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(task_count_for(builder.settings, work, kWorkPerTask), useful));
    const std::size_t room = cells.largest_tile + kLanePadding;
    const std::size_t records = builder.records.count + kLanePadding;
    return cells.sorted_lights.resize(records) && cells.sorted_low.resize(records) &&
           cells.sorted_high.resize(records) && cells.scratch.resize(kScratchWords * room * cells.tile_tasks) &&
           cells.runs.resize(run_room(builder.records, cells.largest_tile) * cells.tile_tasks) &&
           cells.heaps.resize(heap_room(builder) * cells.tile_tasks);
}

struct CellKind {
    std::uint32_t node_count;
    bool is_tree;
};

CellKind choose_kind(const Settings& settings, const SliceLanes& slices, std::uint32_t slice, std::uint32_t count,
                     float depths) {
    if (count == 0 || settings.structure == MANYLIGHTS_STRUCTURE_LISTS) return {0, false};
    // A tree of as many lights as a leaf holds would be one leaf.
    const bool is_tree =
        count > settings.leaf_size && (settings.structure == MANYLIGHTS_STRUCTURE_TREES ||
                                       prefers_tree(count, depths, slices.near_depth[slice], slices.far_depth[slice]));
    if (!is_tree) return {list_node_count(count), false};
    return {static_cast<std::uint32_t>(tree_node_count(count, settings.leaf_size)), true};
}

// All lights of a tile are those of its only slice.
void measure_one_slice(std::uint32_t count, SliceSums& sums) {
    sums.counts[0] = sums.end[0] = count;
    sums.first[0] = 0;
    sums.depths[0] = 0.0f; // nothing is decided by it
}

void measure_cells(ManylightsBuilder& builder, const SliceLanes& slices, std::uint64_t t) {
    Cells& cells = builder.cells;
    GridTile& tile = cells.tiles[t];
    const std::uint32_t structure = builder.settings.structure;
    const bool lists = structure == MANYLIGHTS_STRUCTURE_LISTS;
    SliceSums sums;
    if (slices.count == 1 && structure != MANYLIGHTS_STRUCTURE_HYBRID)
        measure_one_slice(tile.record_count, sums);
    else
        measure_slices(slices, cells.sorted(tile), tile.record_count, sums);
    for (std::uint32_t s = 0; s < slices.count; ++s) {
        const CellKind kind = choose_kind(builder.settings, slices, s, sums.counts[s], sums.depths[s]);
        const std::uint64_t cell = t * slices.count + s;
        cells.cells[cell] = {sums.counts[s], sums.first[s], sums.end[s],
                             static_cast<std::uint32_t>(lists ? tile.reference_count : tile.node_count)};
        cells.is_tree[cell] = kind.is_tree ? 1 : 0;
        tile.reference_count += sums.counts[s];
        tile.node_count += kind.node_count;
        if (kind.is_tree)
            ++tile.tree_cells;
        else if (sums.counts[s] != 0)
            ++tile.list_cells;
    }
}

void measure_task(ManylightsBuilder& builder, std::uint32_t task) {
    const TileRecords& records = builder.records;
    Cells& cells = builder.cells;
    const CellScratch scratch = cell_scratch(builder, task);
    const auto before = [&](std::uint64_t tile) { return work_before(builder, tile); };
    const Part part = part_of(before(records.tile_count), task, cells.tile_tasks);
    const std::uint64_t begin = first_with(records.tile_count, part.begin, before);
    const std::uint64_t end = first_with(records.tile_count, part.end, before);
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        const std::uint64_t first = std::max(begin, grid.tile_offset);
        const std::uint64_t last = std::min(end, grid.tile_offset + grid.tile_count);
        for (std::uint64_t t = first; t < last; ++t) {
            const GridTile& tile = cells.tiles[t];
            if (tile.record_count == 0) continue;
            sort_records(list_runs(records, t, scratch.runs), tile.record_count, scratch.sort, cells.sorted(tile));
            measure_cells(builder, cells.slices[v], t);
        }
    }
}

// Puts the tiles' nodes and references one behind the other. Offsets are only good where the ends fit 32 bits.
void place_cells(ManylightsBuilder& builder) {
    Cells& cells = builder.cells;
    Counts& counts = builder.counts;
    counts.references = counts.nodes = 0;
    cells.list_cells = cells.tree_cells = 0;
    for (std::uint64_t t = 0; t < builder.records.tile_count; ++t) {
        GridTile& tile = cells.tiles[t];
        tile.first_reference = static_cast<std::uint32_t>(counts.references);
        tile.first_node = static_cast<std::uint32_t>(counts.nodes);
        counts.references += tile.reference_count;
        counts.nodes += tile.node_count;
        cells.list_cells += tile.list_cells;
        cells.tree_cells += tile.tree_cells;
    }
}

void make_slices_of_views(ManylightsBuilder& builder) {
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        float farthest = 0.0f;
        for (std::size_t task = 0; task < builder.records.tasks.size(); ++task)
            farthest = std::max(farthest, builder.records.tasks[task].farthest[v]);
        builder.cells.slices[v] =
            make_slice_lanes(builder.slices, builder.views[v].camera.near_depth, builder.settings.slice_far, farthest);
    }
}

} // namespace

SliceLanes make_slice_lanes(const Slices& slices, double camera_near, float slice_far, float farthest) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    SliceLanes lanes;
    lanes.count = slices.count;
    // Nothing reaches what is behind the last one.
    std::fill(std::begin(lanes.begin), std::end(lanes.begin), kInfinity);
    std::fill(std::begin(lanes.end), std::end(lanes.end), -kInfinity);
    std::fill(std::begin(lanes.near_depth), std::end(lanes.near_depth), 0.0f);
    std::fill(std::begin(lanes.far_depth), std::end(lanes.far_depth), 0.0f);
    for (std::uint32_t s = 0; s < slices.count; ++s) {
        lanes.begin[s] = s == 0 ? -kInfinity : slices.edges[s];
        lanes.end[s] = s + 1 == slices.count ? kInfinity : slices.edges[s + 1];
        lanes.near_depth[s] = s == 0 ? static_cast<float>(std::min(camera_near, 3e38)) : slices.edges[s];
        lanes.far_depth[s] =
            s + 1 == slices.count ? std::max(slice_far, std::min(farthest, 1e30f)) : slices.edges[s + 1];
    }
    return lanes;
}

// O'Donnell and Chajdas, Tiled Light Trees, listing 2, where the cell's "radius" is read as half of its depth extent.
bool prefers_tree(std::uint32_t count, float sum_of_depths, float cell_near, float cell_far) {
    const double half_extent = 0.5 * (static_cast<double>(cell_far) - static_cast<double>(cell_near));
    return sum_of_depths < half_extent * count;
}

CellScratch cell_scratch(ManylightsBuilder& builder, std::uint32_t task) {
    Cells& cells = builder.cells;
    const std::size_t room = cells.largest_tile + kLanePadding;
    std::uint32_t* const words = cells.scratch.data() + kScratchWords * room * task;
    const auto floats = [&](std::size_t i) { return reinterpret_cast<float*>(words + i * room); };
    return {cells.runs.data() + run_room(builder.records, cells.largest_tile) * task,
            {floats(3), words + 4 * room},
            {words, floats(1), floats(2)},
            cells.heaps.data() + heap_room(builder) * task};
}

void Cells::use(const Allocator& allocator) {
    for (Array<std::uint32_t>* array : {&sorted_lights, &scratch}) array->use(allocator);
    for (Array<float>* array : {&sorted_low, &sorted_high}) array->use(allocator);
    tiles.use(allocator);
    cells.use(allocator);
    is_tree.use(allocator);
    runs.use(allocator);
    heaps.use(allocator);
}

Fit arrange_cells(ManylightsBuilder& builder, const ManylightsLights& lights, bool has_to_do) {
    Cells& cells = builder.cells;
    Counts& counts = builder.counts;
    const std::uint64_t most = builder.most_elements;
    // Each record is at least one reference.
    const std::uint64_t budget = has_to_do ? most : builder.settings.max_bytes / sizeof(MlUint);
    if (Fit fit = collect_records(builder, lights, std::min(most, budget), has_to_do); fit != Fit::kFits) return fit;
    if (!cells.tiles.resize(builder.records.tile_count) || !cells.cells.resize(counts.cells) ||
        !cells.is_tree.resize(counts.cells))
        return Fit::kOutOfMemory;
    place_records(builder);
    if (!prepare_tasks(builder)) return Fit::kOutOfMemory;
    make_slices_of_views(builder);
    run_tasks(builder.settings, cells.tile_tasks, [&](std::uint32_t task) { measure_task(builder, task); });
    place_cells(builder);
    if (counts.references > most || counts.nodes > most) return Fit::kTooLarge;
    return within_budget(builder) ? Fit::kFits : Fit::kOverBudget;
}

} // namespace manylights::detail
