#include "lab/techniques/octree/octree_levels.h"

#include "lab/gpu/prefix_sum.h"
#include "lab/scene/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace manylights::lab {

namespace {

/// Of octree.glsl.
struct Header {
    std::uint32_t level_count, is_sparse, unused[2];
    glm::uvec4 levels[OctreeLevels::kMost];
};

glm::uvec4 nodes_along(const FroxelGrid& grid, std::uint32_t level) {
    const std::uint32_t edge = 1u << level;
    return {gpu::group_count(grid.tiles().tiles_x, edge), gpu::group_count(grid.tiles().tiles_y, edge),
            gpu::group_count(grid.slice_count(), edge), 0};
}

std::uint32_t level_count_of(const FroxelGrid& grid) {
    const std::uint32_t longest = std::max({grid.tiles().tiles_x, grid.tiles().tiles_y, grid.slice_count()});
    return static_cast<std::uint32_t>(std::bit_width(longest - 1)) + 1;
}

} // namespace

void OctreeLevels::lay_out(const FroxelGrid& grid, bool is_sparse) {
    count_ = level_count_of(grid);
    Header header{count_, is_sparse ? 1u : 0u, {}, {}};
    std::uint64_t nodes = 0;
    for (std::uint32_t level = 0; level < count_; ++level) {
        glm::uvec4& along = header.levels[level] = nodes_along(grid, level);
        along.w = static_cast<std::uint32_t>(nodes);
        first_nodes_[level] = nodes;
        nodes += std::uint64_t{along.x} * along.y * along.z;
    }
    if (!is_sparse && nodes > gpu::PrefixSum::kMaxCount)
        throw InputError(fmt::format("octree: {} x {} tiles of {} slices have {} dense nodes; the most is {}",
                                     grid.tiles().tiles_x, grid.tiles().tiles_y, grid.slice_count(), nodes,
                                     gpu::PrefixSum::kMaxCount));
    first_nodes_[count_] = nodes;
    buffer_.fit(sizeof header);
    buffer_.buffer().upload(std::span<const Header>(&header, 1));
}

} // namespace manylights::lab
