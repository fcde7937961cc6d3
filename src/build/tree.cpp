// Trees and lists of a cell, in vectors of leaves and of nodes.
#include "src/build/tree.h"

#include "src/build/lanes.h"
#include "src/build/node_order.h"
#include "src/format/layout.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/build/tree.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include "src/build/depth_codes-inl.h"
#include "src/build/structs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

constexpr auto kLanes = static_cast<std::uint32_t>(hn::MaxLanes(kW));
static_assert(4 * kLanes <= kSpanPadding && kSmallNodes == kSmallTreeNodes);

// One complete tree over some of a cell's lights.
struct Tree {
    TreeShape shape;
    std::uint32_t light_count;
    std::uint32_t first_reference;
    NodeDepths* heap;

    // Lights in the leaves before this one. The product is less than 2^31: kMaxLeaves * (kMaxLeafLights + 1).
    std::uint32_t lights_before(std::uint32_t leaf) const {
        return std::min(leaf * shape.lights_per_leaf, light_count);
    }
};

// A subtree of 2^level leaves has 2 * 2^level - 1 nodes, which is what its root skips.
MlNode node_of(const Tree& tree, std::uint32_t first_leaf, std::uint32_t level) {
    const std::uint32_t begin = tree.lights_before(first_leaf);
    const std::uint32_t count = tree.lights_before(first_leaf + (1u << level)) - begin;
    const MlUint bits = level == 0 ? pack_leaf(count) : pack_inner(count, (2u << level) - 1);
    const std::uint32_t at = (tree.shape.leaf_count + first_leaf) >> level;
    return {tree.heap[at].low, tree.heap[at].high, tree.first_reference + begin, bits};
}

HWY_INLINE Depths unite(const Depths& a, const Depths& b) { return {hn::Min(a.low, b.low), hn::Max(a.high, b.high)}; }
HWY_INLINE void store(const Depths& depths, NodeDepths* to) {
    hn::StoreInterleaved2(depths.low, depths.high, kF, &to->low);
}

// Of lights side by side.
HWY_INLINE NodeDepths unite_lights(const DepthCodes& codes, const DepthSpan* spans, std::uint32_t count) {
    const Floats infinity = hn::Inf(kF);
    Depths all = {infinity, hn::Neg(infinity)};
    for (std::uint32_t i = 0; i < count; i += kLanes) {
        const auto here = hn::FirstN(kF, count - i);
        const Depths depths = decode(codes, hn::LoadU(kW, spans + i));
        all = {hn::Min(all.low, hn::IfThenElse(here, depths.low, infinity)),
               hn::Max(all.high, hn::IfThenElse(here, depths.high, hn::Neg(infinity)))};
    }
    return {hn::GetLane(hn::MinOfLanes(kF, all.low)), hn::GetLane(hn::MaxOfLanes(kF, all.high))};
}

// All that are full; returns how many. What is written behind them counts for nothing.
HWY_INLINE std::uint32_t fill_full_leaves(const DepthCodes& codes, const DepthSpan* spans, const Tree& tree) {
    const std::uint32_t per_leaf = tree.shape.lights_per_leaf;
    const std::uint32_t full = tree.light_count / per_leaf;
    NodeDepths* const leaves = tree.heap + tree.shape.leaf_count;
    Words a, b, c, d;
    switch (per_leaf) {
    case 3: // the default leaf size of 4 makes leaves of 3 or 4
        for (std::uint32_t leaf = 0; leaf < full; leaf += kLanes) {
            hn::LoadInterleaved3(kW, spans + 3 * leaf, a, b, c);
            store(unite(unite(decode(codes, a), decode(codes, b)), decode(codes, c)), leaves + leaf);
        }
        break;
    case 4:
        for (std::uint32_t leaf = 0; leaf < full; leaf += kLanes) {
            hn::LoadInterleaved4(kW, spans + 4 * leaf, a, b, c, d);
            store(unite(unite(decode(codes, a), decode(codes, b)), unite(decode(codes, c), decode(codes, d))),
                  leaves + leaf);
        }
        break;
    default:
        for (std::uint32_t leaf = 0; leaf < full; ++leaf)
            leaves[leaf] = unite_lights(codes, spans + leaf * per_leaf, per_leaf);
    }
    return full;
}

// Bottom up: each parent is the union of its two children. Behind the full leaves comes one with what is left, if any,
// and the padding.
HWY_INLINE void fill_heap(const DepthCodes& codes, const DepthSpan* spans, const Tree& tree) {
    NodeDepths* const heap = tree.heap;
    const std::uint32_t leaves = tree.shape.leaf_count;
    std::uint32_t filled = fill_full_leaves(codes, spans, tree);
    const std::uint32_t begin = tree.lights_before(filled);
    if (begin < tree.light_count)
        heap[leaves + filled++] = unite_lights(codes, spans + begin, tree.light_count - begin);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (; filled < leaves; ++filled) heap[leaves + filled] = {kInfinity, -kInfinity};
    std::uint32_t parents = leaves / 2;
    for (; parents >= kLanes; parents /= 2) {
        for (std::uint32_t i = parents; i < 2 * parents; i += kLanes) {
            Depths left, right;
            hn::LoadInterleaved4(kF, &heap[2 * i].low, left.low, left.high, right.low, right.high);
            store(unite(left, right), heap + i);
        }
    }
    if (parents == 0) return;
    for (std::uint32_t i = 2 * parents - 1; i >= 1; --i)
        heap[i] = {std::min(heap[2 * i].low, heap[2 * i + 1].low), std::max(heap[2 * i].high, heap[2 * i + 1].high)};
}

// As node_of, for a vector of nodes. A small tree's counts do not saturate: kLeafLights is the most that it takes.
constexpr std::uint32_t kLeafLights = kMaxLeafLights >> kSmallHeight;
HWY_INLINE void write_small_tree(const Tree& tree, MlNode* out) {
    const auto height = static_cast<std::uint32_t>(std::countr_zero(tree.shape.leaf_count));
    const std::uint32_t* const first_leaf = kNodeOrder.first_leaf + (kSmallHeight - height);
    const std::uint32_t* const level = kNodeOrder.level + (kSmallHeight - height);
    const Words one = hn::Set(kW, 1);
    const Words per_leaf = hn::Set(kW, tree.shape.lights_per_leaf);
    const Words lights = hn::Set(kW, tree.light_count);
    const Words leaves = hn::Set(kW, tree.shape.leaf_count);
    HWY_ALIGN std::uint32_t words[kLanes];
    for (std::uint32_t i = 0; i < tree.shape.node_count(); i += kLanes) {
        const Words leaf = hn::LoadU(kW, first_leaf + i);
        const Words levels = hn::LoadU(kW, level + i);
        const Words width = hn::Shl(one, levels);
        const Words begin = hn::Min(leaf * per_leaf, lights);
        const Words count = hn::Min((leaf + width) * per_leaf, lights) - begin;
        const Words at = hn::And(hn::Shr(leaves + leaf, levels), hn::Set(kW, 2 * tree.shape.leaf_count - 1));
        hn::Store(at + at, kW, words);
        const TwoFloats depths = load_pairs(&tree.heap->low, words);
        const Words is_leaf = hn::IfThenElseZero(levels == hn::Zero(kW), hn::Set(kW, ML_NODE_LEAF));
        const Words bits = hn::Or(hn::Or(hn::ShiftLeft<ML_NODE_COUNT_SHIFT>(count), is_leaf), width + width - one);
        hn::StoreInterleaved4(hn::BitCast(kW, depths.a), hn::BitCast(kW, depths.b),
                              hn::Set(kW, tree.first_reference) + begin, bits, kW,
                              reinterpret_cast<std::uint32_t*>(out + i));
    }
}

HWY_INLINE MlNode* write_large_tree(const Tree& tree, MlNode* out) {
    const auto height = static_cast<std::uint32_t>(std::countr_zero(tree.shape.leaf_count));
    for (std::uint32_t leaf = 0; leaf < tree.shape.leaf_count; ++leaf) {
        std::uint32_t level = leaf == 0 ? height : static_cast<std::uint32_t>(std::countr_zero(leaf));
        for (; level > 0; --level) *out++ = node_of(tree, leaf, level);
        *out++ = node_of(tree, leaf, 0);
    }
    return out;
}

} // namespace

MlNode* write_trees(const CellLights& lights, std::uint32_t leaf_size, NodeDepths* heap, MlNode* nodes) {
    for (std::uint32_t begin = 0; begin < lights.count;) {
        const std::uint32_t count = std::min(lights.count - begin, kMaxTreeLights);
        const Tree tree = {tree_shape(count, leaf_size), count, lights.first_reference + begin, heap};
        fill_heap(lights.codes, lights.spans + begin, tree);
        begin += count;
        if (count == lights.count && tree.shape.node_count() <= kSmallTreeNodes &&
            tree.shape.lights_per_leaf <= kLeafLights) {
            write_small_tree(tree, nodes);
            return nodes + tree.shape.node_count();
        }
        nodes = write_large_tree(tree, nodes);
    }
    return nodes;
}

MlNode* write_list(const CellLights& lights, MlNode* nodes) {
    for (std::uint32_t begin = 0; begin < lights.count;) {
        const std::uint32_t count = std::min(lights.count - begin, kMaxLeafLights);
        const NodeDepths depths = unite_lights(lights.codes, lights.spans + begin, count);
        *nodes++ = {depths.low, depths.high, lights.first_reference + begin, pack_leaf(count)};
        begin += count;
    }
    return nodes;
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manylights::detail {

HWY_EXPORT(write_trees);
HWY_EXPORT(write_list);

DepthCodes make_depth_codes(float least, float most) {
    const auto bits = [](float depth) {
        return std::bit_cast<std::int32_t>(std::clamp(depth, 0.0f, std::numeric_limits<float>::max()));
    };
    // The first codes and the last ones are for what is beyond these depths.
    int shift = 3;
    while ((bits(most) >> shift) - (bits(least) >> shift) > DepthCodes::kMostLow - 3) ++shift;
    const std::int32_t longest = (bits(4.0f * most) >> DepthCodes::kExtentShift) + 2;
    return {std::max((bits(most) >> shift) + 2 - DepthCodes::kMostLow, 0),
            std::max(longest - DepthCodes::kMostExtent, 0), shift};
}

MlNode* write_trees(const CellLights& lights, std::uint32_t leaf_size, NodeDepths* heap, MlNode* nodes) {
    return HWY_DYNAMIC_DISPATCH(write_trees)(lights, leaf_size, heap, nodes);
}

MlNode* write_list(const CellLights& lights, MlNode* nodes) { return HWY_DYNAMIC_DISPATCH(write_list)(lights, nodes); }

} // namespace manylights::detail
#endif
