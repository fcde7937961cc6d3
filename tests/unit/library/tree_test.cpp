// Trees and lists on their own.

#include "src/build/tree.h"
#include "src/format/layout.h"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

namespace manylights::test {
namespace {

using namespace detail;

TEST(TreeShape, FitsThePackedFields) {
    for (const std::uint32_t leaf_size : {1u, 3u, 4u, 65535u}) {
        for (const std::uint32_t count :
             {1u, 2u, 4u, 5u, 16384u, 65535u, 65536u, 65537u, 200000u, 4000000u, kMaxTreeLights - 1, kMaxTreeLights}) {
            const TreeShape shape = tree_shape(count, leaf_size);
            EXPECT_LE(shape.node_count(), ML_NODE_SKIP_MAX);
            EXPECT_LE(shape.lights_per_leaf, kMaxLeafLights);
            EXPECT_TRUE(std::has_single_bit(shape.leaf_count));
            EXPECT_GE(static_cast<std::uint64_t>(shape.leaf_count) * shape.lights_per_leaf, count);
            EXPECT_LE(shape.lights_per_leaf, std::max(leaf_size, divide_up(count, kMaxLeaves)));
        }
    }
    EXPECT_EQ(tree_shape(65536, 4).leaf_count, 16384u);
    EXPECT_EQ(tree_node_count(kMaxTreeLights, 4), 32767u);
    EXPECT_EQ(tree_node_count(kMaxTreeLights + 1, 4), 32768u) << "a second tree of one leaf";
    EXPECT_EQ(list_node_count(65535), 1u);
    EXPECT_EQ(list_node_count(65536), 2u);
}

// Near ends from 1 on in steps of 2^-13, extents from 2^-13 on.
constexpr DepthCodes kCodes = {.base = 0x3F800000 >> 10, .extent_base = 0x39000000 >> 16, .shift = 10};

struct BuiltTree {
    std::vector<DepthSpan> spans;
    std::vector<float> low, high; // of them
    std::vector<MlNode> nodes;
};

BuiltTree build_tree(std::uint32_t count, std::uint32_t leaf_size) {
    BuiltTree built;
    Random random(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto begin = i % 60000 + static_cast<std::uint32_t>(random.between(0, 2000));
        const auto extent = static_cast<std::uint32_t>(random.between(1, 1500));
        const DepthSpan span = begin | extent << DepthCodes::kLowBits;
        built.spans.push_back(span);
        built.low.push_back(kCodes.low_of(span));
        built.high.push_back(kCodes.high_of(span));
    }
    built.spans.resize(count + kSpanPadding, 0);
    const std::uint64_t node_count = tree_node_count(count, leaf_size);
    built.nodes.resize(node_count + kSpanPadding);
    const std::size_t room = 2 * std::size_t{tree_shape(count, leaf_size).leaf_count} + kSpanPadding;
    std::vector<NodeDepths> heap(room);
    const CellLights cell = {built.spans.data(), count, 100, kCodes};
    EXPECT_EQ(write_trees(cell, leaf_size, heap.data(), built.nodes.data()), built.nodes.data() + node_count);
    built.nodes.resize(node_count);
    return built;
}

// Five lights, two per leaf: three leaves are needed, four are made, the last one is padding.
TEST(Tree, IsDepthFirstWithSkipCountsAndPadding) {
    const BuiltTree built = build_tree(5, 2);
    ASSERT_EQ(built.nodes.size(), 7u);
    const std::uint32_t skips[] = {7, 3, 1, 1, 3, 1, 1};
    const std::uint32_t counts[] = {5, 4, 2, 2, 1, 1, 0};
    const std::uint32_t firsts[] = {100, 100, 100, 102, 104, 104, 105};
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(ml_node_skip_count(built.nodes[i].bits), skips[i]) << i;
        EXPECT_EQ(ml_node_light_count(built.nodes[i].bits), counts[i]) << i;
        EXPECT_EQ(built.nodes[i].first, firsts[i]) << i;
        EXPECT_EQ(ml_node_is_leaf(built.nodes[i].bits), skips[i] == 1) << i;
    }
    EXPECT_EQ(built.nodes[6].min_depth, std::numeric_limits<float>::infinity());
    EXPECT_EQ(built.nodes[6].max_depth, -std::numeric_limits<float>::infinity());
}

// A node's bounds are those of its lights, neither more nor less; and nothing hits padding. Small trees and large ones,
// leaves of each size that has a way of its own.
TEST(Tree, NodesAreTheUnionsOfTheirLights) {
    for (const std::uint32_t leaf_size : {1u, 2u, 3u, 4u, 5u, 300u}) {
        for (const std::uint32_t count : {1u, 2u, 7u, 13u, 33u, 64u, 65u, 1000u, 1024u, 1025u, 3000u}) {
            const BuiltTree built = build_tree(count, leaf_size);
            for (const MlNode& node : built.nodes) {
                float low = std::numeric_limits<float>::infinity(); // what padding has
                float high = -low;
                for (std::uint32_t i = 0; i < ml_node_light_count(node.bits); ++i) {
                    low = std::min(low, built.low[node.first - 100 + i]);
                    high = std::max(high, built.high[node.first - 100 + i]);
                }
                ASSERT_EQ(node.min_depth, low);
                ASSERT_EQ(node.max_depth, high);
            }
        }
    }
}

// Small trees are written in vectors, large ones node by node: the same bits, counts and firsts.
TEST(Tree, IsDepthFirstWhateverItsSize) {
    for (const std::uint32_t leaf_size : {1u, 3u, 4u, 300u}) {
        for (std::uint32_t count = 1; count <= 4100; count = count < 70 ? count + 1 : count * 2 - 3) {
            const BuiltTree built = build_tree(count, leaf_size);
            const TreeShape shape = tree_shape(count, leaf_size);
            const auto before = [&](std::uint32_t leaf) { return std::min(leaf * shape.lights_per_leaf, count); };
            std::size_t at = 0;
            for (std::uint32_t leaf = 0; leaf < shape.leaf_count; ++leaf) {
                const std::uint32_t widest = leaf == 0 ? shape.leaf_count : leaf & (~leaf + 1);
                for (std::uint32_t width = widest; width >= 1; width /= 2, ++at) {
                    const MlNode& node = built.nodes[at];
                    ASSERT_EQ(ml_node_skip_count(node.bits), 2 * width - 1);
                    ASSERT_EQ(ml_node_is_leaf(node.bits), width == 1);
                    ASSERT_EQ(node.first, 100 + before(leaf));
                    ASSERT_EQ(ml_node_light_count(node.bits), before(leaf + width) - before(leaf));
                }
            }
            ASSERT_EQ(at, built.nodes.size());
        }
    }
}

// Misses alone must end exactly behind the last node.
TEST(Tree, SkippingEverythingEndsAtTheEnd) {
    for (const std::uint32_t count : {1u, 9u, 65536u, 65537u, 200000u}) {
        const BuiltTree built = build_tree(count, 4);
        EXPECT_EQ(ml_node_skip_count(built.nodes[0].bits), built.nodes.size());
        for (std::size_t first = 0; first < std::min<std::size_t>(built.nodes.size(), 64); ++first) {
            std::size_t at = first;
            while (at < built.nodes.size()) at += ml_node_skip_count(built.nodes[at].bits);
            EXPECT_EQ(at, built.nodes.size());
        }
    }
}

TEST(List, SplitsIntoLeavesThatCountTheirLights) {
    BuiltTree built = build_tree(65537, 4);
    std::vector<MlNode> nodes(2);
    const CellLights cell = {built.spans.data(), 65537, 100, kCodes};
    EXPECT_EQ(write_list(cell, nodes.data()), nodes.data() + 2);
    EXPECT_EQ(ml_node_light_count(nodes[0].bits), 65535u);
    EXPECT_EQ(ml_node_light_count(nodes[1].bits), 2u);
    EXPECT_EQ(nodes[1].first, 100u + 65535u);
    EXPECT_EQ(ml_node_skip_count(nodes[0].bits), 1u);
    EXPECT_EQ(nodes[0].min_depth, *std::min_element(built.low.begin(), built.low.begin() + 65535));
    EXPECT_EQ(nodes[0].max_depth, *std::max_element(built.high.begin(), built.high.begin() + 65535));
}

} // namespace
} // namespace manylights::test
