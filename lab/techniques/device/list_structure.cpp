#include "lab/techniques/device/list_structure.h"

#include <array>
#include <limits>
#include <numeric>

namespace manylights::lab {

namespace {

constexpr std::array<float, 2> kSliceEdges{0.0f, std::numeric_limits<float>::infinity()};

} // namespace

MlView structure_view(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size, std::uint32_t slice_count,
                      MlUint structure) {
    const TileGrid grid = tile_grid(width, height, tile_size);
    MlView view{};
    view.width = width;
    view.height = height;
    view.tile_px = tile_size;
    view.tiles_x = grid.tiles_x;
    view.tiles_y = grid.tiles_y;
    view.slice_count = slice_count;
    view.cell_count = grid.tile_count() * slice_count;
    view.structure = structure;
    return view;
}

ListStructure::ListStructure(gpu::Device& device)
    : views_(device, "view of lists"), nodes_(device, "nodes of lists"),
      slice_edges_(device, "slice edges of lists", std::span<const float>(kSliceEdges)) {}

void ListStructure::fit(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size) {
    const MlView view = structure_view(width, height, tile_size, 1, ML_STRUCTURE_LISTS);
    views_.fit(sizeof view);
    views_.buffer().upload(std::span<const MlView>(&view, 1));
    nodes_.fit(0);
}

std::vector<const gpu::Buffer*> ListStructure::buffers(const TileLists& lists) const {
    return {&views_.buffer(), &slice_edges_, &lists.cells(), &nodes_.buffer(), &lists.references()};
}

std::uint64_t bytes_of(const std::vector<const gpu::Buffer*>& buffers) {
    return std::accumulate(buffers.begin(), buffers.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const gpu::Buffer* buffer) { return sum + buffer->bytes(); });
}

} // namespace manylights::lab
