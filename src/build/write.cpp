#include "src/build/builder.h"

#include <cstring>

namespace manylights::detail {

namespace {

struct WriteJob {
    ManylightsBuilder* builder;
    const ManylightsBuffers* buffers;
};

MlView describe_view(const ManylightsBuilder& builder, std::uint32_t index) {
    const Grid& grid = builder.grids[index];
    MlView view{};
    view.width = grid.width;
    view.height = grid.height;
    view.tile_px = grid.tile_px;
    view.tiles_x = grid.tiles_x;
    view.tiles_y = grid.tiles_y;
    view.structure = builder.settings.structure;
    if (has_windows(builder)) {
        const WindowView& windows = builder.windows.views[index];
        view.cell_offset = static_cast<MlUint>(windows.cell_offset);
        view.cell_count = static_cast<MlUint>(windows.cell_count);
        view.depth_scale = windows.depth_scale;
        return view;
    }
    view.cell_offset = static_cast<MlUint>(grid.cell_offset);
    view.cell_count = static_cast<MlUint>(grid.cell_count);
    view.slice_count = grid.slice_count;
    view.slice_offset = index * (grid.slice_count + 1);
    view.slice_scale = builder.slices.scale;
    view.slice_bias = builder.slices.bias;
    return view;
}

void write_views(const ManylightsBuilder& builder, const ManylightsBuffers& buffers) {
    auto* views = static_cast<MlView*>(buffers.views);
    auto* edges = static_cast<float*>(buffers.slice_edges);
    const std::uint32_t edge_count = builder.slices.count + 1;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const MlView view = describe_view(builder, v);
        std::memcpy(views + v, &view, sizeof(view));
        if (!has_windows(builder))
            std::memcpy(edges + v * edge_count, builder.slices.edges, edge_count * sizeof(float));
    }
}

// What comes before this cell in all buffers together. Strictly ascending, so it cuts the cells into tasks of equal
// work; the cut decides who writes a byte, never which byte.
std::uint64_t work_before(const ManylightsBuilder& builder, std::uint64_t cell) {
    if (has_windows(builder)) {
        const Windows& windows = builder.windows;
        return kHeaderCells * cell +
               (cell < windows.tiles.size() ? windows.tiles[cell].first_reference : windows.references);
    }
    return cell + builder.bins.begin(cell) + builder.nodes.offsets[cell];
}

std::uint64_t first_cell_of_task(const ManylightsBuilder& builder, std::uint32_t task) {
    const std::uint64_t cells = builder.stats.cells;
    const std::uint64_t target = work_before(builder, cells) / builder.task_count * task;
    if (task == builder.task_count) return cells;
    std::uint64_t low = 0;
    std::uint64_t high = cells;
    while (low < high) {
        const std::uint64_t middle = (low + high) / 2;
        if (work_before(builder, middle) < target)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

void write_cell_records(const ManylightsBuilder& builder, std::uint64_t begin, std::uint64_t end, MlCell* cells) {
    const bool lists = builder.settings.structure == MANYLIGHTS_STRUCTURE_LISTS;
    for (std::uint64_t c = begin; c < end; ++c) {
        const std::uint64_t first_node = builder.nodes.offsets[c];
        const std::uint64_t node_count = builder.nodes.offsets[c + 1] - first_node;
        cells[c] = lists ? MlCell{builder.bins.begin(c), builder.bins.count(c)}
                         : MlCell{static_cast<MlUint>(first_node), static_cast<MlUint>(node_count)};
    }
}

void write_nodes(const ManylightsBuilder& builder, std::uint64_t begin, std::uint64_t end, DepthSpan* heap,
                 MlNode* nodes) {
    if (builder.settings.structure == MANYLIGHTS_STRUCTURE_LISTS) return;
    nodes += builder.nodes.offsets[begin];
    for (std::uint64_t c = begin; c < end; ++c) {
        const CellLights lights = {builder.sorted.data(), builder.bins.ranks.data() + builder.bins.begin(c),
                                   builder.bins.count(c), builder.bins.begin(c)};
        nodes = builder.nodes.is_tree[c] != 0 ? write_trees(lights, builder.settings.leaf_size, heap, nodes)
                                              : write_list(lights, nodes);
    }
}

void write_references(const ManylightsBuilder& builder, std::uint64_t begin, std::uint64_t end, MlUint* references) {
    const std::uint64_t last = builder.bins.begin(end);
    for (std::uint64_t i = builder.bins.begin(begin); i < last; ++i)
        references[i] = builder.sorted[builder.bins.ranks[i]].index;
}

void write_window_task(void* context, std::uint32_t task) {
    const auto& job = *static_cast<const WriteJob*>(context);
    ManylightsBuilder& builder = *job.builder;
    if (task == 0) write_views(builder, *job.buffers);
    write_window_tiles(builder, task, first_cell_of_task(builder, task), first_cell_of_task(builder, task + 1),
                       *job.buffers);
}

void write_task(void* context, std::uint32_t task) {
    const auto& job = *static_cast<const WriteJob*>(context);
    ManylightsBuilder& builder = *job.builder;
    if (task == 0) write_views(builder, *job.buffers);
    const std::uint64_t begin = first_cell_of_task(builder, task);
    const std::uint64_t end = first_cell_of_task(builder, task + 1);
    const std::size_t heap_size = 2 * static_cast<std::size_t>(builder.nodes.largest_tree_leaves);
    write_cell_records(builder, begin, end, static_cast<MlCell*>(job.buffers->cells));
    write_nodes(builder, begin, end, builder.heaps.data() + heap_size * task, static_cast<MlNode*>(job.buffers->nodes));
    write_references(builder, begin, end, static_cast<MlUint*>(job.buffers->references));
}

} // namespace

void write_buffers(ManylightsBuilder& builder, const ManylightsBuffers& buffers) {
    WriteJob job = {&builder, &buffers};
    const ManylightsTask task = has_windows(builder) ? write_window_task : write_task;
    if (builder.task_count == 1)
        task(&job, 0);
    else
        builder.settings.parallel_for(builder.settings.parallel_user, builder.task_count, task, &job);
}

} // namespace manylights::detail
