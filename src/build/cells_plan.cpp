// The cells of all tiles: their lights, whether they hold a list or a tree, and the exact counts of what write replays.
#include "src/build/record_stages.h"

#include <algorithm>
#include <cstring>

namespace manylights::detail {

namespace {

// What spans more than this, compared with what may be, was not misjudged by the sample.
constexpr std::uint64_t kEstimateMargin = 4;

void measure_views(ManylightsBuilder& builder) {
    Cells& cells = builder.cells;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        float farthest = 0.0f;
        for (std::size_t task = 0; task < cells.box_tasks.size(); ++task)
            farthest = std::max(farthest, cells.box_tasks[task].sums[v].farthest);
        cells.extents[v] = make_slice_extents(builder.slices, builder.views[v].camera.near_depth,
                                              builder.settings.slice_far, farthest);
    }
}

std::uint64_t count_references(const ManylightsBuilder& builder) {
    std::uint64_t sum = 0;
    for (std::size_t task = 0; task < builder.cells.box_tasks.size(); ++task)
        for (std::uint32_t v = 0; v < builder.view_count; ++v) sum += builder.cells.box_tasks[task].sums[v].cells;
    return sum;
}

struct CellSum {
    std::uint32_t count, extents;
};

// Adds what a task has of some cells, to nothing if it is the first; keeps how many, for the next time. Returns how
// many there are of all of them.
std::uint64_t add_cells(const CellPool pool, bool is_first, std::uint64_t begin, std::uint64_t end,
                        std::uint32_t* counts, CellSum* sums) {
    std::uint64_t all = 0;
    for (std::uint64_t c = begin; c < end; ++c) {
        const CellCursor& cursor = pool.cursors[c];
        const std::uint32_t count = list_length(pool, c);
        CellSum& sum = sums[c - begin];
        sum = {(is_first ? 0 : sum.count) + count, (is_first ? 0 : sum.extents) + cursor.extent_sum};
        counts[c] = count;
        all += count;
    }
    return all;
}

GridCell choose_kind(const Settings& settings, const CellSum& sum) {
    if (settings.structure == MANYLIGHTS_STRUCTURE_LISTS) return {sum.count, 0, 0};
    // A tree of as many lights as a leaf holds would be one leaf.
    const bool is_tree = sum.count > settings.leaf_size &&
                         (settings.structure == MANYLIGHTS_STRUCTURE_TREES || prefers_tree(sum.extents));
    if (!is_tree) return {sum.count, list_node_count(sum.count), 0};
    return {sum.count, static_cast<std::uint32_t>(tree_node_count(sum.count, settings.leaf_size)), 1};
}

void measure_block(ManylightsBuilder& builder, std::uint64_t index) {
    Cells& cells = builder.cells;
    const std::uint64_t cell_count = builder.counts.cells;
    const std::uint64_t begin = index * kBlockCells;
    const std::uint64_t end = std::min(cell_count, begin + kBlockCells);
    CellSum sums[kBlockCells];
    CellBlock block{};
    for (std::size_t task = 0; task < cells.pools.size(); ++task)
        block.first_reference +=
            add_cells(cells.pools[task], task == 0, begin, end, cells.counts.data() + task * cell_count, sums);
    GridCell* const out = cells.cells.data() + begin;
    std::memset(static_cast<void*>(out), 0, (end - begin) * sizeof(GridCell));
    for (std::uint64_t i = 0; block.first_reference != 0 && i < end - begin; ++i) {
        if (sums[i].count == 0) continue;
        const GridCell cell = choose_kind(builder.settings, sums[i]);
        out[i] = cell;
        block.first_node += cell.node_count;
        block.tree_cells += cell.is_tree;
        block.list_cells += 1 - cell.is_tree;
        block.largest = std::max(block.largest, cell.count);
    }
    cells.blocks[index] = block;
}

// False: out of memory.
bool measure_blocks(ManylightsBuilder& builder) {
    constexpr std::uint64_t kBlocksPerTask = 32;
    Cells& cells = builder.cells;
    const std::uint64_t blocks = (builder.counts.cells + (kBlockCells - 1)) / kBlockCells;
    if (!cells.cells.resize(builder.counts.cells) || !cells.blocks.resize(blocks + 1)) return false;
    const std::uint32_t task_count = task_count_for(builder.settings, blocks, kBlocksPerTask);
    run_tasks(builder.settings, task_count, [&](std::uint32_t task) {
        const Part part = part_of(blocks, task, task_count);
        for (std::uint64_t b = part.begin; b < part.end; ++b) measure_block(builder, b);
    });
    return true;
}

// Puts the blocks' nodes and references one behind the other; behind the last block are the sums. Offsets are only good
// where these fit 32 bits.
void place_blocks(Cells& cells) {
    CellBlock sums{};
    for (std::uint64_t b = 0; b + 1 < cells.blocks.size(); ++b) {
        CellBlock& block = cells.blocks[b];
        const CellBlock here = block;
        block.first_reference = sums.first_reference;
        block.first_node = sums.first_node;
        sums.first_reference += here.first_reference;
        sums.first_node += here.first_node;
        sums.list_cells += here.list_cells;
        sums.tree_cells += here.tree_cells;
        sums.largest = std::max(sums.largest, here.largest);
    }
    cells.blocks[cells.blocks.size() - 1] = sums;
}

// No more tasks than the largest cell leaves work for: each has room for that one.
bool prepare_writing(ManylightsBuilder& builder) {
    constexpr std::uint64_t kWorkPerTask = 1024; // references, nodes and cells
    Cells& cells = builder.cells;
    const Counts& counts = builder.counts;
    const std::uint64_t work = counts.references + counts.nodes + counts.cells;
    const std::uint64_t useful = work / std::max(cells.largest_cell(), 1u) + 1;
    cells.write_tasks = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(task_count_for(builder.settings, work, kWorkPerTask), useful));
    return cells.spans.resize(cell_room(cells) * cells.write_tasks) &&
           cells.heaps.resize(heap_room(builder) * cells.write_tasks);
}

} // namespace

SliceExtents make_slice_extents(const Slices& slices, double camera_near, float slice_far, float farthest) {
    SliceExtents extents{};
    std::copy_n(slices.edges, slices.count, extents.edges);
    extents.edges[0] = static_cast<float>(std::min(camera_near, 3e38));
    extents.edges[slices.count] = std::max(slice_far, std::min(farthest, 1e30f));
    return extents;
}

std::size_t cell_room(const Cells& cells) { return std::size_t{cells.largest_cell()} + kSpanPadding; }

std::size_t heap_room(const ManylightsBuilder& builder) {
    const std::uint32_t lights = std::clamp(builder.cells.largest_cell(), 1u, kMaxTreeLights);
    return 2 * static_cast<std::size_t>(tree_shape(lights, builder.settings.leaf_size).leaf_count) + kSpanPadding;
}

void Cells::use(const Allocator& allocator) {
    for (Array<std::uint32_t>* array :
         {&found_bands, &band_steps, &bands, &block_pixels, &homes, &firsts, &counts, &next, &buffers, &spans})
        array->use(allocator);
    for (Array<CellRecord>* array : {&records, &segment_records}) array->use(allocator);
    block_floats.use(allocator);
    heaps.use(allocator);
    for (Array<LightBox>* array : {&found, &boxes}) array->use(allocator);
    box_tasks.use(allocator);
    segments.use(allocator);
    pools.use(allocator);
    cursors.use(allocator);
    cells.use(allocator);
    blocks.use(allocator);
}

Fit arrange_cells(ManylightsBuilder& builder, const ManylightsLights& lights, bool has_to_do) {
    Counts& counts = builder.counts;
    const std::uint64_t most = builder.most_elements;
    const std::uint64_t limit =
        has_to_do ? most : std::min(most, builder.settings.max_bytes / sizeof(MlUint)); // of references
    // A light has a reference in each of its tiles at least.
    if (!has_to_do && estimate_tiles(builder, builder.grids[0].tile_px) / kEstimateMargin > limit)
        return Fit::kOverBudget;
    if (!order_boxes(builder, lights)) return Fit::kOutOfMemory;
    measure_views(builder);
    counts.references = count_references(builder);
    if (counts.references > limit) return has_to_do ? Fit::kTooLarge : Fit::kOverBudget;
    if (!deal_lights(builder) || !measure_blocks(builder)) return Fit::kOutOfMemory;
    place_blocks(builder.cells);
    counts.nodes = builder.cells.blocks[builder.cells.blocks.size() - 1].first_node;
    if (counts.nodes > most) return Fit::kTooLarge;
    if (!prepare_writing(builder)) return Fit::kOutOfMemory;
    return within_budget(builder) ? Fit::kFits : Fit::kOverBudget;
}

} // namespace manylights::detail
