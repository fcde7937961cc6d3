#include "src/build/record_stages.h"

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
    view.cell_offset = static_cast<MlUint>(grid.cell_offset());
    view.cell_count = static_cast<MlUint>(grid.cell_count());
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

// What comes before this tile, or block of cells, in all buffers together. Ascending, so it cuts them into tasks of
// equal work; the cut decides who writes a byte, never which byte.
std::uint64_t work_before(const ManylightsBuilder& builder, std::uint64_t part) {
    if (!has_windows(builder)) {
        const CellBlock& block = builder.cells.blocks[part];
        return part * kBlockCells + block.first_reference + block.first_node;
    }
    const bool is_end = part == builder.records.tile_count;
    return kHeaderCells * part + (is_end ? builder.counts.references : builder.windows.tiles[part].first_reference);
}

void write_task(const WriteJob& job, std::uint32_t task) {
    ManylightsBuilder& builder = *job.builder;
    if (task == 0) write_views(builder, *job.buffers);
    const auto before = [&](std::uint64_t part) { return work_before(builder, part); };
    const std::uint64_t parts = has_windows(builder) ? builder.records.tile_count : builder.cells.blocks.size() - 1;
    const Part work = part_of(before(parts), task, builder.task_count);
    const std::uint64_t begin = first_with(parts, work.begin, before);
    const std::uint64_t end = first_with(parts, work.end, before);
    if (has_windows(builder))
        write_window_tiles(builder, task, begin, end, *job.buffers);
    else
        write_cell_blocks(builder, task, begin, end, *job.buffers);
}

} // namespace

void write_buffers(ManylightsBuilder& builder, const ManylightsBuffers& buffers) {
    const WriteJob job = {&builder, &buffers};
    run_tasks(builder.settings, builder.task_count, [&](std::uint32_t task) { write_task(job, task); });
}

} // namespace manylights::detail
