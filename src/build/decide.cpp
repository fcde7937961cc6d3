#include "src/build/decide.h"

#include "src/format/layout.h"

#include <algorithm>

namespace manylights::detail {

namespace {

// The depths of a slice, for the decision alone: the first one begins at the near plane, the last one ends at
// slice_far or with the farthest light, whichever is more.
struct SliceDepths {
    float near_depth, far_depth;
};

SliceDepths depths_of(const Slices& slices, std::uint32_t slice, const Camera& camera, float slice_far,
                      float farthest) {
    const float begin = slice == 0 ? static_cast<float>(std::min(camera.near_depth, 3e38)) : slices.edges[slice];
    const float end = slice + 1 == slices.count ? std::max(slice_far, farthest) : slices.edges[slice + 1];
    return {begin, end};
}

float farthest_depth(const Grid& grid, const VisibleLight* sorted) {
    float farthest = 0.0f;
    for (std::uint64_t i = grid.first_light; i < grid.end_light; ++i)
        farthest = std::max(farthest, sorted[i].max_depth);
    return std::min(farthest, 1e30f);
}

// Only for cells with lights.
bool is_tree_cell(const Settings& settings, const VisibleLight* sorted, const std::uint32_t* ranks, std::uint32_t count,
                  SliceDepths depths) {
    if (count <= settings.leaf_size) return false; // the tree would be one leaf
    if (settings.structure == MANYLIGHTS_STRUCTURE_TREES) return true;
    return prefers_tree(sorted, ranks, count, depths.near_depth, depths.far_depth);
}

void add_cell(const Settings& settings, std::uint64_t cell, std::uint32_t count, bool is_tree, CellNodes& nodes) {
    nodes.is_tree[cell] = is_tree ? 1 : 0;
    std::uint64_t node_count = 0;
    if (is_tree) {
        node_count = tree_node_count(count, settings.leaf_size);
        const std::uint32_t largest = tree_shape(std::min(count, kMaxTreeLights), settings.leaf_size).leaf_count;
        nodes.largest_tree_leaves = std::max(nodes.largest_tree_leaves, largest);
        ++nodes.tree_cells;
    } else if (count > 0) {
        if (settings.structure != MANYLIGHTS_STRUCTURE_LISTS) node_count = list_node_count(count);
        ++nodes.list_cells;
    } else {
        ++nodes.empty_cells;
    }
    nodes.offsets[cell + 1] = nodes.offsets[cell] + node_count;
}

} // namespace

// O'Donnell and Chajdas, Tiled Light Trees, listing 2, where the cell's "radius" is read as half of its depth extent.
// The sum runs in the cell's order, in double: the same everywhere.
bool prefers_tree(const VisibleLight* sorted, const std::uint32_t* ranks, std::uint32_t count, float cell_near,
                  float cell_far) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const VisibleLight& light = sorted[ranks[i]];
        const double low = std::max(light.min_depth, cell_near);
        const double high = std::min(light.max_depth, cell_far);
        if (high > low) sum += high - low;
    }
    const double half_extent = 0.5 * (static_cast<double>(cell_far) - static_cast<double>(cell_near));
    return sum < half_extent * count;
}

bool decide_cells(const Settings& settings, const Slices& slices, const Grid* grids, const View* views,
                  std::uint32_t grid_count, const VisibleLight* sorted, const Bins& bins, CellNodes& nodes) {
    const std::uint64_t cells = grids[grid_count - 1].cell_offset + grids[grid_count - 1].cell_count;
    if (!nodes.offsets.resize(cells + 1) || !nodes.is_tree.resize(cells)) return false;
    nodes.offsets[0] = 0;
    nodes.largest_tree_leaves = 0;
    nodes.empty_cells = nodes.list_cells = nodes.tree_cells = 0;
    const bool has_trees = settings.structure != MANYLIGHTS_STRUCTURE_LISTS;
    for (std::uint32_t g = 0; g < grid_count; ++g) {
        const Grid& grid = grids[g];
        const float farthest = farthest_depth(grid, sorted);
        std::uint64_t cell = grid.cell_offset;
        for (std::uint32_t slice = 0; slice < grid.slice_count; ++slice) {
            const SliceDepths depths = depths_of(slices, slice, views[g].camera, settings.slice_far, farthest);
            for (std::uint32_t tile = 0; tile < grid.tiles_x * grid.tiles_y; ++tile, ++cell) {
                const std::uint32_t count = bins.count(cell);
                const std::uint32_t* ranks = bins.ranks.data() + bins.begin(cell);
                const bool is_tree = has_trees && count > 0 && is_tree_cell(settings, sorted, ranks, count, depths);
                add_cell(settings, cell, count, is_tree, nodes);
            }
        }
    }
    return true;
}

} // namespace manylights::detail
