#include "reference/paper/radix_sort.h"
#include "reference/paper/tree.h"
#include "tests/unit/paper/cases.h"
#include "tests/unit/paper/reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

namespace manylights::paper {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<std::uint32_t> breadth_first_order(std::uint32_t levels) {
    std::vector<std::uint32_t> order;
    for (const DepthFirstEntry& entry : depth_first_table(levels)) order.push_back(entry.breadth_first);
    return order;
}

TEST(DepthFirstTable, IsTheSlides) {
    EXPECT_EQ(breadth_first_order(1), (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(breadth_first_order(2), (std::vector<std::uint32_t>{2, 0, 1}));
    EXPECT_EQ(breadth_first_order(3), (std::vector<std::uint32_t>{6, 4, 0, 1, 5, 2, 3}));
}

// The slides' skip formula with the root on level 0; leaves come in order.
TEST(DepthFirstTable, SkipsAndLeavesOfEveryDepth) {
    for (std::uint32_t levels = 1; levels <= kMaxTreeLevels; ++levels) {
        const auto table = depth_first_table(levels);
        const std::uint32_t leaves = 1u << (levels - 1);
        ASSERT_EQ(table.size(), 2 * leaves - 1);
        std::uint32_t next_leaf = 0;
        for (const DepthFirstEntry& entry : table) {
            // Level k of the tree holds the breadth-first places from node_count - 2^(k + 1) + 1 on.
            const std::uint32_t from_root = std::uint32_t(table.size()) - entry.breadth_first;
            const std::uint32_t level = std::uint32_t(std::bit_width(from_root)) - 1;
            ASSERT_EQ(entry.skip, (1u << (levels - level)) - 1);
            if (entry.skip == 1) {
                ASSERT_EQ(entry.breadth_first, next_leaf++);
            }
        }
        EXPECT_EQ(next_leaf, leaves);
    }
}

std::vector<DepthRange> random_ranges(std::uint32_t count, std::uint32_t seed) {
    Random random(seed);
    std::vector<DepthRange> ranges(count);
    for (DepthRange& range : ranges) {
        const double center = random.between(5, 500), radius = random.between(0.1, 8);
        range = {float(center - radius), float(center + radius)};
    }
    std::sort(ranges.begin(), ranges.end(), [](auto a, auto b) { return a.min + a.max < b.min + b.max; });
    return ranges;
}

std::vector<MlNode> build_tree(const std::vector<DepthRange>& ranges, std::uint32_t leaf_size,
                               TreeBuild build = TreeBuild::bottom_up) {
    TreeBuilder builder;
    builder.build_cell({100, std::uint32_t(ranges.size()), ranges.data()}, {0.1f, 500.0f},
                       {.structure = Structure::tree, .leaf_size = leaf_size, .tree_build = build});
    std::vector<MlNode> nodes(builder.node_count());
    builder.pack(nodes.data());
    return nodes;
}

// Returns the end of the subtree; checks that it bounds its lights exactly, in order, and skips itself.
std::size_t expect_subtree(const std::vector<MlNode>& nodes, std::size_t node, const std::vector<DepthRange>& ranges,
                           std::uint32_t& next_light) {
    const MlNode& top = nodes[node];
    const std::uint32_t first_light = next_light;
    std::size_t end = node + 1;
    if (ml_node_is_leaf(top.bits)) {
        next_light += ml_node_light_count(top.bits);
    } else {
        end = expect_subtree(nodes, end, ranges, next_light);
        end = expect_subtree(nodes, end, ranges, next_light);
        EXPECT_EQ(ml_node_light_count(top.bits), std::min(next_light - first_light, 65535u));
    }
    EXPECT_EQ(node + ml_node_skip_count(top.bits), end);
    EXPECT_EQ(top.first, 100 + first_light);
    float lower = kInfinity, upper = -kInfinity;
    for (std::uint32_t i = first_light; i < next_light; ++i) {
        lower = std::min(lower, ranges[i].min);
        upper = std::max(upper, ranges[i].max);
    }
    EXPECT_EQ(top.min_depth, lower);
    EXPECT_EQ(top.max_depth, upper);
    return end;
}

TEST(Tree, BoundsItsLightsOnEveryLevel) {
    for (std::uint32_t count : {1u, 2u, 4u, 5u, 13u, 31u, 32u, 33u, 100u, 1234u, 60000u}) {
        for (std::uint32_t leaf_size : {1u, 4u, 6u}) {
            const std::uint32_t leaves = std::bit_ceil((count + leaf_size - 1) / leaf_size);
            if (leaves > kMaxTreeLeaves) continue;
            SCOPED_TRACE(std::to_string(count) + " lights, leaf " + std::to_string(leaf_size));
            const auto ranges = random_ranges(count, count);
            const auto nodes = build_tree(ranges, leaf_size);
            ASSERT_EQ(nodes.size(), 2 * leaves - 1);
            std::uint32_t next_light = 0;
            EXPECT_EQ(expect_subtree(nodes, 0, ranges, next_light), nodes.size());
            EXPECT_EQ(next_light, count);
        }
    }
}

TEST(Tree, TopDownBoundsItsLightsOnEveryLevelAndHasNoPadding) {
    for (std::uint32_t count : {1u, 2u, 4u, 5u, 13u, 31u, 32u, 33u, 100u, 1234u, 16384u}) {
        for (std::uint32_t leaf_size : {1u, 4u, 6u}) {
            SCOPED_TRACE(std::to_string(count) + " lights, leaf " + std::to_string(leaf_size));
            const auto ranges = random_ranges(count, count);
            const auto nodes = build_tree(ranges, leaf_size, TreeBuild::top_down);
            std::uint32_t next_light = 0;
            EXPECT_EQ(expect_subtree(nodes, 0, ranges, next_light), nodes.size());
            EXPECT_EQ(next_light, count);
            for (const MlNode& node : nodes) {
                const std::uint32_t lights = ml_node_light_count(node.bits);
                EXPECT_TRUE(lights > 0 && (!ml_node_is_leaf(node.bits) || lights <= leaf_size));
            }
        }
    }
}

// Three lights in front and five far behind: an even split would join the gap into a node.
TEST(Tree, TopDownSplitsAtAGap) {
    std::vector<DepthRange> ranges;
    for (int i = 0; i < 8; ++i) ranges.push_back({i < 3 ? 10.0f : 400.0f, i < 3 ? 20.0f : 410.0f});
    const auto nodes = build_tree(ranges, 5, TreeBuild::top_down);
    ASSERT_EQ(nodes.size(), 3u);
    EXPECT_EQ(ml_node_light_count(nodes[1].bits), 3u);
    EXPECT_EQ(nodes[1].max_depth, 20.0f);
    EXPECT_EQ(nodes[2].min_depth, 400.0f);
}

// Ever larger lights around the first one make the most uneven splits; more lights than one tree's leaves hold.
TEST(Tree, TopDownFitsItsFields) {
    std::vector<DepthRange> ranges;
    for (std::uint32_t i = 0; i < 60000; ++i)
        ranges.push_back({250.0f - 0.004f * float(i), 250.0f + 0.004f * float(i)});
    for (const std::uint32_t leaf_size : {1u, 4u, 8u, 100u}) {
        const auto nodes = build_tree(ranges, leaf_size, TreeBuild::top_down);
        std::uint32_t next_light = 0;
        std::size_t node = 0, trees = 0;
        for (; node < nodes.size(); ++trees) node = expect_subtree(nodes, node, ranges, next_light);
        EXPECT_EQ(next_light, 60000u);
        EXPECT_EQ(trees, leaf_size < 16 ? 4u : 1u);
    }
}

// Every leaf that a depth of the slice hits is inside, and nothing smaller would do.
TEST(Tree, EntryInASliceHoldsWhatItsDepthsHit) {
    Random random(5);
    for (const TreeBuild build : {TreeBuild::bottom_up, TreeBuild::top_down}) {
        const auto nodes = build_tree(random_ranges(300, 7), 2, build);
        const MlCell tile{0, std::uint32_t(nodes.size())};
        std::size_t smaller = 0, empty = 0;
        for (int i = 0; i < 500; ++i) {
            const float lower = float(random.between(0, 600));
            const SliceExtent slice{lower, lower + float(random.between(0.01, 60))};
            const MlCell entry = entry_in_slice(nodes.data(), tile, slice);
            for (std::uint32_t node = 0; node < nodes.size(); ++node) {
                const bool hit = nodes[node].min_depth < slice.max && nodes[node].max_depth >= slice.min;
                if (!ml_node_is_leaf(nodes[node].bits) || !hit) continue;
                EXPECT_TRUE(entry.first <= node && node < entry.first + entry.count);
            }
            smaller += entry.count < tile.count;
            empty += entry.count == 0;
        }
        EXPECT_GT(smaller, 400u);
        EXPECT_GT(empty, 20u);
    }
}

TEST(Tree, PaddingIsNeverHitAndStaysInside) {
    const auto nodes = build_tree(random_ranges(33, 1), 4); // 16 leaves of 3: 11 used
    std::uint32_t padding = 0;
    for (const MlNode& node : nodes) {
        if (!ml_node_is_leaf(node.bits) || ml_node_light_count(node.bits) != 0) continue;
        ++padding;
        EXPECT_EQ(node.first, 133u);
        for (float depth : {0.0f, 1.0f, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()})
            EXPECT_FALSE(node.min_depth <= depth && depth <= node.max_depth);
    }
    EXPECT_EQ(padding, 5u);
}

TEST(Heuristics, Listing2AndItsReadings) {
    const SliceExtent extent{10.0f, 20.0f};
    // Clipped to [10, 20]: 4, 6, 8; mean 6. Diameters: 4, 16, 8; mean 28 / 3.
    const std::vector<DepthRange> ranges{{11, 15}, {0, 16}, {12, 20}};
    const CellLights lights{0, 3, ranges.data()};
    EXPECT_FALSE(prefers_tree(Heuristic::clipped_half_extent, lights, extent)); // 6 < 5
    EXPECT_TRUE(prefers_tree(Heuristic::clipped_extent, lights, extent));       // 6 < 10
    EXPECT_TRUE(prefers_tree(Heuristic::diameter_extent, lights, extent));      // 9.3 < 10
    EXPECT_TRUE(prefers_tree(Heuristic::always_tree, lights, extent));
    EXPECT_FALSE(prefers_tree(Heuristic::always_list, lights, extent));

    const std::vector<DepthRange> small{{11, 13}, {12, 14}};
    EXPECT_TRUE(prefers_tree(Heuristic::clipped_half_extent, {0, 2, small.data()}, extent)); // 2 < 5
    const std::vector<DepthRange> half{{10, 15}, {15, 20}};
    EXPECT_FALSE(prefers_tree(Heuristic::clipped_half_extent, {0, 2, half.data()}, extent)); // strictly less
    const std::vector<DepthRange> large{{5, 25}};
    EXPECT_FALSE(prefers_tree(Heuristic::clipped_extent, {0, 1, large.data()}, extent));
    EXPECT_FALSE(prefers_tree(Heuristic::diameter_extent, {0, 1, large.data()}, extent));
}

TEST(Heuristics, ExpectedCostComparesTreeAndList) {
    const Options options{.leaf_size = 1, .heuristic = Heuristic::expected_cost};
    const SliceExtent extent{0.0f, 100.0f};
    TreeBuilder builder;
    std::vector<DepthRange> apart, together;
    for (int i = 0; i < 8; ++i) {
        apart.push_back({12.0f * float(i), 12.0f * float(i) + 1.0f});
        together.push_back({0.0f, 100.0f});
    }
    // Apart: a chance of 0.01 for each light; the root is hit with 0.85, inner nodes with less.
    EXPECT_EQ(builder.build_cell({0, 8, apart.data()}, extent, options), 15u);
    EXPECT_TRUE(builder.built_tree());
    EXPECT_EQ(builder.build_cell({0, 8, together.data()}, extent, options), 1u);
    EXPECT_FALSE(builder.built_tree());
    EXPECT_EQ(builder.node_count(), 16u);
}

TEST(RadixSort, OrdersFloatsStably) {
    Random random(1);
    for (std::uint32_t count : {0u, 1u, 2u, 1000u, 65537u}) {
        std::vector<std::pair<float, std::uint32_t>> expected;
        RadixSort sort;
        SortPair* pairs = sort.pairs(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            const float depth = float(int(random.between(-500, 500))) * (i % 3 == 0 ? 1e-3f : 1.0f);
            expected.emplace_back(depth == 0.0f ? 0.0f : depth, i); // one zero: the sign of zero orders the keys
            pairs[i] = {sort_key(expected.back().first), i};
        }
        std::stable_sort(expected.begin(), expected.end(), [](auto a, auto b) { return a.first < b.first; });
        const SortPair* sorted = sort.sort(count);
        for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(sorted[i].rank, expected[i].second) << i;
    }
}

} // namespace
} // namespace manylights::paper
