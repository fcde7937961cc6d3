// ml_begin and ml_next over handmade lists, trees and forests, against plain loops.

#include "tests/shader/shader_text.h"

#include "reference/oracle/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace manylights::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A complete tree over ranges[first, last), depth first, leaf_count a power of two; padding leaves where lights run
/// out. Recursion for clarity; the text under test only ever walks forwards.
DepthRange append_tree(HandmadeBuffers& buffers, const std::vector<DepthRange>& ranges, MlUint first, MlUint last,
                       MlUint leaf_count, MlUint lights_per_leaf) {
    DepthRange all{kInfinity, -kInfinity};
    last = std::max(first, last);
    for (MlUint i = first; i < last; ++i) {
        all.min = std::min(all.min, ranges[i].min);
        all.max = std::max(all.max, ranges[i].max);
    }
    if (leaf_count == 1) {
        buffers.nodes.push_back(make_leaf(all, first, last - first));
        return all;
    }
    MlUint skip = 2 * leaf_count - 1;
    MlUint count = std::min(last - first, ML_NODE_COUNT_MAX);
    buffers.nodes.push_back({all.min, all.max, first, (count << ML_NODE_COUNT_SHIFT) | skip});
    MlUint half = leaf_count / 2;
    MlUint middle = std::min(last, first + half * lights_per_leaf);
    append_tree(buffers, ranges, first, middle, half, lights_per_leaf);
    append_tree(buffers, ranges, middle, last, half, lights_per_leaf);
    return all;
}

MlUint power_of_two_at_least(MlUint value) {
    MlUint result = 1;
    while (result < value) result *= 2;
    return result;
}

std::vector<DepthRange> random_ranges(oracle::Random& random, MlUint count) {
    std::vector<DepthRange> ranges;
    for (MlUint i = 0; i < count; ++i) {
        double center = random.between(0.0, 100.0), radius = random.between(0.0, 5.0);
        ranges.push_back({static_cast<float>(center - radius), static_cast<float>(center + radius)});
    }
    std::sort(ranges.begin(), ranges.end(), [](DepthRange a, DepthRange b) { return a.min + a.max < b.min + b.max; });
    return ranges;
}

HandmadeBuffers with_references(MlUint structure, MlUint count) {
    HandmadeBuffers buffers;
    buffers.frame_view = one_cell_view(structure);
    buffers.slice_edges = {0.0f, kInfinity};
    buffers.references.resize(count);
    for (MlUint i = 0; i < count; ++i) buffers.references[i] = 7u * i + 3u;
    return buffers;
}

HandmadeBuffers with_tree(const std::vector<DepthRange>& ranges, MlUint leaf_size) {
    MlUint count = static_cast<MlUint>(ranges.size());
    HandmadeBuffers buffers = with_references(ML_STRUCTURE_TREES, count);
    append_tree(buffers, ranges, 0, count, power_of_two_at_least((count + leaf_size - 1) / leaf_size), leaf_size);
    buffers.cells = {{0, static_cast<MlUint>(buffers.nodes.size())}};
    return buffers;
}

int times(const Walk& walk, MlUint light) {
    return static_cast<int>(std::count(walk.lights.begin(), walk.lights.end(), light));
}

TEST(MlNext, AListHandsOutItsReferencesInOrderAtAnyDepth) {
    for (MlUint count : {0u, 1u, 2u, 100u}) {
        HandmadeBuffers buffers = with_references(ML_STRUCTURE_LISTS, count + 10);
        buffers.cells = {{5, count}};
        for (float depth : {0.0f, 1.0f, -1.0f, kInfinity, kNan}) {
            Walk result = walk(buffers, depth);
            ASSERT_EQ(result.lights.size(), count);
            EXPECT_TRUE(std::equal(result.lights.begin(), result.lights.end(), buffers.references.begin() + 5));
            EXPECT_EQ(result.tested, count);
            EXPECT_EQ(result.references, count);
            EXPECT_EQ(result.nodes, 1u) << "the cell";
        }
        EXPECT_EQ(buffers.reads_outside, 0);
    }
}

TEST(MlNext, ATreeHandsOutEveryLightWhoseRangeHoldsTheDepthOnce) {
    oracle::Random random(2);
    for (MlUint count : {1u, 2u, 3u, 4u, 5u, 31u, 32u, 33u, 257u})
        for (MlUint leaf_size : {1u, 3u, 4u, 64u}) {
            std::vector<DepthRange> ranges = random_ranges(random, count);
            HandmadeBuffers buffers = with_tree(ranges, leaf_size);
            for (const DepthRange& at : ranges)
                for (float depth : {at.min, at.max, (at.min + at.max) * 0.5f, std::nextafter(at.max, 1e9f)}) {
                    Walk result = walk(buffers, depth);
                    for (MlUint i = 0; i < count; ++i) {
                        int expected = ranges[i].min <= depth && depth <= ranges[i].max ? 1 : 0;
                        int found = times(result, buffers.references[i]);
                        ASSERT_TRUE(leaf_size == 1 ? found == expected : (found >= expected && found <= 1))
                            << count << " lights, leaves of " << leaf_size << ", depth " << depth << ", light " << i;
                    }
                    ASSERT_EQ(result.node, result.node_end);
                }
            EXPECT_EQ(buffers.reads_outside, 0);
        }
}

TEST(MlNext, MissesEndExactlyAtTheEndOfTheCell) {
    std::vector<DepthRange> ranges(33, DepthRange{10.0f, 20.0f});
    for (MlUint leaf_size : {1u, 2u, 8u}) {
        HandmadeBuffers buffers = with_tree(ranges, leaf_size);
        for (float depth : {0.0f, 9.999f, 20.001f, -kInfinity, kInfinity, kNan}) {
            Walk result = walk(buffers, depth);
            EXPECT_TRUE(result.lights.empty());
            EXPECT_EQ(result.node, result.node_end);
            EXPECT_EQ(result.nodes, 1u + 1u) << "the root must skip everything";
        }
    }
}

TEST(MlNext, LeavingEachInnerNodeAloneEndsExactlyBehindItsSubtree) {
    // Lights far apart: at the depth of one of them, exactly the path to it is entered and all else is skipped.
    std::vector<DepthRange> ranges;
    for (MlUint i = 0; i < 64; ++i) ranges.push_back({static_cast<float>(10 * i), static_cast<float>(10 * i + 1)});
    HandmadeBuffers buffers = with_tree(ranges, 1);
    for (MlUint i = 0; i < 64; ++i) {
        Walk result = walk(buffers, static_cast<float>(10 * i));
        EXPECT_EQ(result.lights, std::vector<MlUint>{buffers.references[i]});
        EXPECT_EQ(result.node, result.node_end);
        EXPECT_EQ(result.nodes, 1u + 1u + 2u * 6u) << "the cell, both children of each node on the path";
    }
}

TEST(MlNext, PaddingLeavesNeverHit) {
    std::vector<DepthRange> ranges{{-kInfinity, kInfinity}, {0.0f, 0.0f}, {1.0f, kInfinity}};
    HandmadeBuffers buffers = with_tree(ranges, 1);
    ASSERT_EQ(buffers.nodes.size(), 7u);
    ASSERT_EQ(ml_node_light_count(buffers.nodes[6].bits), 0u);
    // A padding leaf that were entered would hand out what lies behind the list.
    buffers.nodes[6].bits |= 1u << ML_NODE_COUNT_SHIFT;
    for (float depth : {0.0f, -0.0f, 1.0f, kInfinity, -kInfinity, kNan, 3.4e38f, -3.4e38f}) walk(buffers, depth);
    EXPECT_EQ(buffers.reads_outside, 0);
    EXPECT_EQ(walk(buffers, 0.0f).lights.size(), 2u);
    EXPECT_EQ(walk(buffers, kInfinity).lights.size(), 2u);
    EXPECT_EQ(walk(buffers, -kInfinity).lights.size(), 1u);
    EXPECT_TRUE(walk(buffers, kNan).lights.empty());
}

TEST(MlNext, ALeafOfTheLargestCountIsHandedOutWhole) {
    constexpr MlUint kCount = ML_NODE_COUNT_MAX;
    ASSERT_EQ(kCount, 65535u);
    HandmadeBuffers buffers = with_tree(std::vector<DepthRange>(kCount, DepthRange{1.0f, 2.0f}), kCount);
    ASSERT_EQ(buffers.nodes.size(), 1u);
    EXPECT_EQ(ml_node_light_count(buffers.nodes[0].bits), kCount);
    EXPECT_TRUE(ml_node_is_leaf(buffers.nodes[0].bits));
    EXPECT_EQ(walk(buffers, 1.5f).lights, buffers.references);
    EXPECT_TRUE(walk(buffers, 2.5f).lights.empty());
}

TEST(MlNext, AListOfMoreIsARunOfLeaves) {
    HandmadeBuffers buffers = with_references(ML_STRUCTURE_HYBRID, 200000);
    for (MlUint first = 0; first < 200000; first += ML_NODE_COUNT_MAX)
        buffers.nodes.push_back(make_leaf({1.0f, 2.0f}, first, std::min(ML_NODE_COUNT_MAX, 200000u - first)));
    buffers.cells = {{0, 4}};
    EXPECT_EQ(walk(buffers, 1.0f).lights, buffers.references);
    EXPECT_EQ(walk(buffers, 3.0f).nodes, 1u + 4u);
}

TEST(MlNext, TheLargestTreeFitsItsSkipCount) {
    HandmadeBuffers buffers = with_tree(std::vector<DepthRange>(16384, DepthRange{1.0f, 2.0f}), 1);
    ASSERT_EQ(buffers.nodes.size(), 32767u);
    EXPECT_EQ(ml_node_skip_count(buffers.nodes[0].bits), 32767u);
    EXPECT_EQ(ml_node_light_count(buffers.nodes[0].bits), 16384u);
    EXPECT_FALSE(ml_node_is_leaf(buffers.nodes[0].bits));
    EXPECT_EQ(walk(buffers, 3.0f).nodes, 1u + 1u);
    EXPECT_EQ(walk(buffers, 1.0f).lights, buffers.references);
}

TEST(MlNext, AForestIsWalkedTreeByTree) {
    HandmadeBuffers buffers = with_references(ML_STRUCTURE_TREES, 24);
    std::vector<DepthRange> ranges;
    for (MlUint i = 0; i < 24; ++i) ranges.push_back({static_cast<float>(i % 8), static_cast<float>(i % 8) + 0.5f});
    for (MlUint tree = 0; tree < 3; ++tree) append_tree(buffers, ranges, 8 * tree, 8 * tree + 8, 8, 1);
    buffers.cells = {{0, static_cast<MlUint>(buffers.nodes.size())}};
    for (MlUint i = 0; i < 8; ++i) {
        std::vector<MlUint> expected{buffers.references[i], buffers.references[i + 8], buffers.references[i + 16]};
        EXPECT_EQ(walk(buffers, static_cast<float>(i) + 0.25f).lights, expected);
    }
    EXPECT_EQ(walk(buffers, 100.0f).nodes, 1u + 3u);
}

TEST(MlNext, TwoCursorsLiveSideBySideAndStayAtTheEnd) {
    HandmadeBuffers buffers = with_tree(std::vector<DepthRange>(10, DepthRange{1.0f, 2.0f}), 2);
    auto a = buffers.ml_begin(buffers.frame_view, {0.5f, 0.5f}, 1.0f);
    auto b = a;
    MlUint light_a, light_b;
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(buffers.ml_next(a, light_a));
        ASSERT_TRUE(buffers.ml_next(b, light_b));
        EXPECT_EQ(light_a, light_b);
    }
    for (int i = 0; i < 3; ++i) {
        EXPECT_FALSE(buffers.ml_next(a, light_a));
        EXPECT_EQ(light_a, 0u);
    }
    EXPECT_FALSE(buffers.ml_next(b, light_b));
}

TEST(MlNext, CountersCountWhatIsRead) {
    // Root, left child, its two leaves (one of them hit), and the right child missed.
    HandmadeBuffers buffers = with_tree({{0.0f, 1.0f}, {2.0f, 3.0f}, {4.0f, 5.0f}, {6.0f, 7.0f}}, 1);
    Walk result = walk(buffers, 2.5f);
    EXPECT_EQ(result.tested, 1u);
    EXPECT_EQ(result.references, 1u);
    EXPECT_EQ(result.nodes, 1u + 5u);
    result = walk(buffers, 3.5f);
    EXPECT_EQ(result.tested, 0u);
    EXPECT_EQ(result.nodes, 1u + 3u);
}

} // namespace
} // namespace manylights::test
