#include "src/build/tree.h"

#include "src/format/layout.h"

#include <algorithm>
#include <limits>

namespace manylights::detail {

namespace {

// What nothing reaches: no depth is above +inf and below -inf. The identity of a union.
constexpr DepthSpan kNowhere = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};

DepthSpan unite(DepthSpan a, DepthSpan b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }

DepthSpan span_of(const CellLights& lights, std::uint32_t begin, std::uint32_t end) {
    DepthSpan span = kNowhere;
    for (std::uint32_t i = begin; i < end; ++i) {
        const VisibleLight& light = lights.sorted[lights.ranks[i]];
        span = unite(span, {light.min_depth, light.max_depth});
    }
    return span;
}

// One complete tree over some of a cell's lights.
struct Tree {
    TreeShape shape;
    std::uint32_t light_count;
    std::uint32_t first_reference;
    const DepthSpan* heap; // 1 is the root, 2i and 2i + 1 are the children of i, the leaves are the last leaf_count

    // Lights in the leaves before this one.
    std::uint32_t lights_before(std::uint32_t leaf) const {
        const std::uint64_t full = static_cast<std::uint64_t>(leaf) * shape.lights_per_leaf;
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(full, light_count));
    }
};

// Bottom up: each parent is the union of its two children.
void fill_heap(const CellLights& lights, std::uint32_t begin, const Tree& tree, DepthSpan* heap) {
    const std::uint32_t leaves = tree.shape.leaf_count;
    for (std::uint32_t leaf = 0; leaf < leaves; ++leaf)
        heap[leaves + leaf] = span_of(lights, begin + tree.lights_before(leaf), begin + tree.lights_before(leaf + 1));
    for (std::uint32_t i = leaves - 1; i >= 1; --i) heap[i] = unite(heap[2 * i], heap[2 * i + 1]);
}

// Depth first: the node, then its left half, then its right half. A subtree of m leaves has 2m - 1 nodes, which is
// what its root skips.
MlNode* write_subtree(const Tree& tree, std::uint32_t heap_index, std::uint32_t first_leaf, std::uint32_t leaf_count,
                      MlNode* out) {
    const std::uint32_t begin = tree.lights_before(first_leaf);
    const std::uint32_t count = tree.lights_before(first_leaf + leaf_count) - begin;
    const DepthSpan span = tree.heap[heap_index];
    const MlUint bits = leaf_count == 1 ? pack_leaf(count) : pack_inner(count, 2 * leaf_count - 1);
    *out++ = {span.low, span.high, tree.first_reference + begin, bits};
    if (leaf_count == 1) return out;
    const std::uint32_t half = leaf_count / 2;
    out = write_subtree(tree, 2 * heap_index, first_leaf, half, out);
    return write_subtree(tree, 2 * heap_index + 1, first_leaf + half, half, out);
}

} // namespace

MlNode* write_trees(const CellLights& lights, std::uint32_t leaf_size, DepthSpan* heap, MlNode* nodes) {
    for (std::uint32_t begin = 0; begin < lights.count;) {
        const std::uint32_t count = std::min(lights.count - begin, kMaxTreeLights);
        const Tree tree = {tree_shape(count, leaf_size), count, lights.first_reference + begin, heap};
        fill_heap(lights, begin, tree, heap);
        nodes = write_subtree(tree, 1, 0, tree.shape.leaf_count, nodes);
        begin += count;
    }
    return nodes;
}

MlNode* write_list(const CellLights& lights, MlNode* nodes) {
    for (std::uint32_t begin = 0; begin < lights.count;) {
        const std::uint32_t count = std::min(lights.count - begin, kMaxLeafLights);
        const DepthSpan span = span_of(lights, begin, begin + count);
        *nodes++ = {span.low, span.high, lights.first_reference + begin, pack_leaf(count)};
        begin += count;
    }
    return nodes;
}

} // namespace manylights::detail
