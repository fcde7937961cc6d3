#include "src/build/tree.h"

#include "src/format/layout.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace manylights::detail {

namespace {

// What nothing reaches: no depth is above +inf and below -inf. The identity of a union.
constexpr DepthSpan kNowhere = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};

DepthSpan unite(DepthSpan a, DepthSpan b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }

DepthSpan span_of(const CellLights& lights, std::uint32_t begin, std::uint32_t end) {
    DepthSpan span = kNowhere;
    for (std::uint32_t i = begin; i < end; ++i) span = unite(span, {lights.low[i], lights.high[i]});
    return span;
}

// One complete tree over some of a cell's lights.
struct Tree {
    TreeShape shape;
    std::uint32_t light_count;
    std::uint32_t first_reference;
    const DepthSpan* heap; // 1 is the root, 2i and 2i + 1 are the children of i, the leaves are the last leaf_count

    // Lights in the leaves before this one. The product is less than 2^31: kMaxLeaves * (kMaxLeafLights + 1).
    std::uint32_t lights_before(std::uint32_t leaf) const {
        return std::min(leaf * shape.lights_per_leaf, light_count);
    }
};

// Full leaves of so many lights each: a loop of known length has no branch to guess.
template <std::uint32_t kLights>
void fill_leaves(const float* low, const float* high, std::uint32_t leaf_count, DepthSpan* leaves) {
    for (std::uint32_t leaf = 0; leaf < leaf_count; ++leaf) {
        DepthSpan span = {low[kLights * leaf], high[kLights * leaf]};
        for (std::uint32_t i = 1; i < kLights; ++i)
            span = unite(span, {low[kLights * leaf + i], high[kLights * leaf + i]});
        leaves[leaf] = span;
    }
}

// All that are full; returns how many.
std::uint32_t fill_full_leaves(const CellLights& lights, std::uint32_t begin, const Tree& tree, DepthSpan* leaves) {
    const std::uint32_t per_leaf = tree.shape.lights_per_leaf;
    const std::uint32_t full = tree.light_count / per_leaf;
    const float* const low = lights.low + begin;
    const float* const high = lights.high + begin;
    switch (per_leaf) {
    case 1:
        fill_leaves<1>(low, high, full, leaves);
        break;
    case 2:
        fill_leaves<2>(low, high, full, leaves);
        break;
    case 3:
        fill_leaves<3>(low, high, full, leaves);
        break;
    case 4:
        fill_leaves<4>(low, high, full, leaves);
        break;
    default:
        for (std::uint32_t leaf = 0; leaf < full; ++leaf)
            leaves[leaf] = span_of(lights, begin + leaf * per_leaf, begin + (leaf + 1) * per_leaf);
    }
    return full;
}

// Bottom up: each parent is the union of its two children. Behind the full leaves comes one with what is left, if any,
// and the padding.
void fill_heap(const CellLights& lights, std::uint32_t begin, const Tree& tree, DepthSpan* heap) {
    const std::uint32_t leaves = tree.shape.leaf_count;
    const std::uint32_t full = fill_full_leaves(lights, begin, tree, heap + leaves);
    for (std::uint32_t leaf = full; leaf < leaves; ++leaf)
        heap[leaves + leaf] = span_of(lights, begin + tree.lights_before(leaf), begin + tree.lights_before(leaf + 1));
    for (std::uint32_t i = leaves - 1; i >= 1; --i) heap[i] = unite(heap[2 * i], heap[2 * i + 1]);
}

// A subtree of 2^level leaves has 2 * 2^level - 1 nodes, which is what its root skips.
MlNode* write_node(const Tree& tree, std::uint32_t first_leaf, std::uint32_t level, MlNode* out) {
    const std::uint32_t begin = tree.lights_before(first_leaf);
    const std::uint32_t count = tree.lights_before(first_leaf + (1u << level)) - begin;
    const DepthSpan span = tree.heap[(tree.shape.leaf_count + first_leaf) >> level];
    const MlUint bits = level == 0 ? pack_leaf(count) : pack_inner(count, (2u << level) - 1);
    *out = {span.low, span.high, tree.first_reference + begin, bits};
    return out + 1;
}

// Depth first: before a leaf come the nodes whose first leaf it is, the largest first. Leaf i is the first one of a
// node of 2^k leaves where 2^k divides i.
MlNode* write_tree(const Tree& tree, MlNode* out) {
    const auto height = static_cast<std::uint32_t>(std::countr_zero(tree.shape.leaf_count));
    for (std::uint32_t leaf = 0; leaf < tree.shape.leaf_count; ++leaf) {
        std::uint32_t level = leaf == 0 ? height : static_cast<std::uint32_t>(std::countr_zero(leaf));
        for (; level > 0; --level) out = write_node(tree, leaf, level, out);
        out = write_node(tree, leaf, 0, out);
    }
    return out;
}

} // namespace

MlNode* write_trees(const CellLights& lights, std::uint32_t leaf_size, DepthSpan* heap, MlNode* nodes) {
    for (std::uint32_t begin = 0; begin < lights.count;) {
        const std::uint32_t count = std::min(lights.count - begin, kMaxTreeLights);
        const Tree tree = {tree_shape(count, leaf_size), count, lights.first_reference + begin, heap};
        fill_heap(lights, begin, tree, heap);
        nodes = write_tree(tree, nodes);
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
