// Sort, bin, decide and tree on their own.

#include "src/build/bin.h"
#include "src/build/decide.h"
#include "src/build/sort.h"
#include "src/build/tree.h"
#include "src/format/layout.h"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace manylights::test {
namespace {

using namespace detail;

const Allocator kMalloc = {[](void*, std::size_t bytes, std::size_t) { return std::malloc(bytes); },
                           [](void*, void* memory, std::size_t) { std::free(memory); }, nullptr};

VisibleLight light_at(std::uint32_t index, float depth, float range = 1.0f) {
    VisibleLight light{};
    light.index = index;
    light.center_depth = depth;
    light.min_depth = depth - range;
    light.max_depth = depth + range;
    return light;
}

TEST(Sort, KeysFollowTheOrderOfFloats) {
    const float ascending[] = {
        -std::numeric_limits<float>::max(), -2.0f, -1.0f, -1e-40f, -0.0f, 0.0f, 1e-40f, 1.0f, 2.0f,
        std::numeric_limits<float>::max()};
    for (std::size_t i = 1; i < std::size(ascending); ++i)
        EXPECT_LT(sortable_key(ascending[i - 1]), sortable_key(ascending[i]));
}

TEST(Sort, OrdersByDepthAndKeepsEqualDepthsInOrder) {
    for (const std::uint32_t count : {0u, 1u, 2u, 1000u}) {
        Array<VisibleLight> lights;
        Array<VisibleLight> sorted;
        Array<SortItem> items[2];
        for (auto* array : {&lights, &sorted}) array->use(kMalloc);
        for (auto& array : items) array.use(kMalloc);
        Random random(count);
        for (std::uint32_t i = 0; i < count; ++i)
            ASSERT_TRUE(lights.push(light_at(i, std::floor(random.between(-50, 50)))));
        ASSERT_TRUE(sorted.push(light_at(77, 0.0f))) << "of an earlier view";
        ASSERT_TRUE(append_sorted(lights, items, sorted));
        ASSERT_EQ(sorted.size(), count + 1);
        EXPECT_EQ(sorted[0].index, 77u);
        for (std::uint32_t i = 2; i <= count; ++i) {
            const auto& a = sorted[i - 1];
            const auto& b = sorted[i];
            EXPECT_TRUE(a.center_depth < b.center_depth || (a.center_depth == b.center_depth && a.index < b.index));
        }
    }
}

TEST(Bin, PutsALightIntoEachCellOfItsBox) {
    Grid grid{};
    grid.width = 100; // tiles of 16: 7 by 4
    grid.height = 60;
    lay_out(grid, 16, 3, 0);
    EXPECT_EQ(grid.tiles_x, 7u);
    EXPECT_EQ(grid.tiles_y, 4u);
    EXPECT_EQ(grid.cell_count, 84u);
    VisibleLight lights[2] = {light_at(0, 1), light_at(1, 2)};
    lights[0].first_px[0] = 15, lights[0].last_px[0] = 16; // tiles 0 and 1
    lights[0].first_px[1] = 47, lights[0].last_px[1] = 47; // tile 2
    lights[0].first_slice = 1, lights[0].last_slice = 2;
    lights[1].last_px[0] = 99, lights[1].last_px[1] = 59;
    lights[1].last_slice = 2;
    grid.end_light = 2;
    EXPECT_EQ(count_references(grid, lights, 1000), 4u + 84u);
    EXPECT_GT(count_references(grid, lights, 2), 2u) << "stops, but says that there are more";

    Bins bins;
    bins.offsets.use(kMalloc);
    bins.ranks.use(kMalloc);
    ASSERT_TRUE(fill_bins(&grid, 1, lights, 88, bins));
    for (std::uint32_t cell = 0; cell < 84; ++cell) {
        const std::uint32_t x = cell % 7;
        const std::uint32_t y = cell / 7 % 4;
        const std::uint32_t s = cell / 28;
        const bool both = x <= 1 && y == 2 && s >= 1;
        ASSERT_EQ(bins.count(cell), both ? 2u : 1u) << cell;
        const std::uint32_t begin = bins.begin(cell);
        ASSERT_EQ(bins.ranks[begin], both ? 0u : 1u);
        ASSERT_EQ(bins.ranks[begin + bins.count(cell) - 1], 1u);
    }
}

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

struct BuiltTree {
    std::vector<VisibleLight> lights;
    std::vector<std::uint32_t> ranks;
    std::vector<MlNode> nodes;
};

BuiltTree build_tree(std::uint32_t count, std::uint32_t leaf_size) {
    BuiltTree built;
    Random random(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        built.lights.push_back(light_at(i, static_cast<float>(i), random.between(0.1, 3)));
        built.ranks.push_back(i);
    }
    built.nodes.resize(tree_node_count(count, leaf_size));
    std::vector<DepthSpan> heap(2 * std::size_t{tree_shape(count, leaf_size).leaf_count});
    const CellLights cell = {built.lights.data(), built.ranks.data(), count, 100};
    EXPECT_EQ(write_trees(cell, leaf_size, heap.data(), built.nodes.data()), built.nodes.data() + built.nodes.size());
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

// A node's bounds are those of its lights, neither more nor less; and nothing hits padding.
TEST(Tree, NodesAreTheUnionsOfTheirLights) {
    for (const std::uint32_t count : {1u, 2u, 7u, 64u, 65u, 1000u}) {
        const BuiltTree built = build_tree(count, 4);
        for (const MlNode& node : built.nodes) {
            float low = std::numeric_limits<float>::infinity();
            float high = -low;
            for (std::uint32_t i = 0; i < ml_node_light_count(node.bits); ++i) {
                low = std::min(low, built.lights[node.first - 100 + i].min_depth);
                high = std::max(high, built.lights[node.first - 100 + i].max_depth);
            }
            EXPECT_EQ(node.min_depth, low);
            EXPECT_EQ(node.max_depth, high);
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
    const CellLights cell = {built.lights.data(), built.ranks.data(), 65537, 100};
    EXPECT_EQ(write_list(cell, nodes.data()), nodes.data() + 2);
    EXPECT_EQ(ml_node_light_count(nodes[0].bits), 65535u);
    EXPECT_EQ(ml_node_light_count(nodes[1].bits), 2u);
    EXPECT_EQ(nodes[1].first, 100u + 65535u);
    EXPECT_EQ(ml_node_skip_count(nodes[0].bits), 1u);
}

// Half of a cell from 10 to 30 is 10: lights that cover less of it, on average, make a tree.
TEST(Decide, ComparesTheClippedMeanWithHalfTheCell) {
    const std::uint32_t ranks[] = {0, 1};
    const auto prefers = [&](float range_a, float range_b) {
        const VisibleLight lights[] = {light_at(0, 20, range_a), light_at(1, 20, range_b)};
        return prefers_tree(lights, ranks, 2, 10.0f, 30.0f);
    };
    EXPECT_TRUE(prefers(4.9f, 4.9f));
    EXPECT_FALSE(prefers(5.0f, 5.0f)) << "strict";
    EXPECT_FALSE(prefers(1000.0f, 1.0f)) << "clipped to 20 and 2";
    EXPECT_TRUE(prefers(9.0f, 0.9f));
    const VisibleLight outside[] = {light_at(0, 50, 1), light_at(1, 50, 1)};
    EXPECT_TRUE(prefers_tree(outside, ranks, 2, 10.0f, 30.0f)) << "clipped to nothing";
}

} // namespace
} // namespace manylights::test
