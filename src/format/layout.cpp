#include "src/format/layout.h"

#include <algorithm>
#include <bit>

namespace manylights::detail {

TreeShape tree_shape(std::uint32_t light_count, std::uint32_t leaf_size) {
    const std::uint32_t smallest_leaf = divide_up(light_count, kMaxLeaves);
    const std::uint32_t lights_per_leaf = std::max(leaf_size, smallest_leaf);
    const std::uint32_t leaf_count = std::bit_ceil(divide_up(light_count, lights_per_leaf));
    return {leaf_count, divide_up(light_count, leaf_count)};
}

std::uint64_t tree_node_count(std::uint32_t light_count, std::uint32_t leaf_size) {
    std::uint64_t nodes = 0;
    while (light_count > 0) {
        const std::uint32_t here = std::min(light_count, kMaxTreeLights);
        nodes += tree_shape(here, leaf_size).node_count();
        light_count -= here;
    }
    return nodes;
}

ManylightsSizes sizes_of(const Counts& counts) {
    return {counts.views * sizeof(MlView), counts.slice_edges * sizeof(float), counts.cells * sizeof(MlCell),
            counts.nodes * sizeof(MlNode), counts.references * counts.reference_words * sizeof(MlUint)};
}

std::uint64_t total_bytes(const ManylightsSizes& sizes) {
    return sizes.views + sizes.slice_edges + sizes.cells + sizes.nodes + sizes.references;
}

} // namespace manylights::detail
