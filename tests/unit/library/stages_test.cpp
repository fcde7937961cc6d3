// Cells, decision and tree on their own.

#include "src/build/bounds.h"
#include "src/build/cells.h"
#include "src/build/tree.h"
#include "src/format/layout.h"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace manylights::test {
namespace {

using namespace detail;

// A tile's records, and what becomes of them. Runs of awkward lengths.
class TileOfCells {
  public:
    explicit TileOfCells(const std::vector<Interval>& depths) : count_(static_cast<std::uint32_t>(depths.size())) {
        const std::size_t room = count_ + kLanePadding;
        records_.resize(room);
        words_.resize(3 * room);
        floats_.resize(5 * room);
        for (std::uint32_t i = 0; i < count_; ++i)
            records_[i] = {i, std::bit_cast<std::uint32_t>(static_cast<float>(depths[i].low)),
                           std::bit_cast<std::uint32_t>(static_cast<float>(depths[i].high))};
        for (std::uint32_t at = 0; at < count_; at += runs_.back().count)
            runs_.push_back({records_.data() + at, std::min(1 + at % 21, count_ - at)});
        const auto arrays = [&](std::size_t i) {
            return DepthArrays{words_.data() + i * room, floats_.data() + 2 * i * room,
                               floats_.data() + (2 * i + 1) * room};
        };
        sorted = arrays(0);
        cell = arrays(1);
        sort_records({runs_.data(), static_cast<std::uint32_t>(runs_.size())}, count_,
                     {floats_.data() + 4 * room, words_.data() + 2 * room}, sorted);
    }

    std::uint32_t count() const { return count_; }
    SliceSums measure(const SliceLanes& slices) const {
        SliceSums sums;
        measure_slices(slices, sorted, count_, sums);
        return sums;
    }

    DepthArrays sorted{}, cell{};

  private:
    std::uint32_t count_;
    std::vector<TileRecord> records_;
    std::vector<RecordRun> runs_;
    std::vector<std::uint32_t> words_;
    std::vector<float> floats_;
};

std::vector<Interval> random_depths(std::uint32_t count, double farthest) {
    Random random(count);
    std::vector<Interval> depths(count);
    for (Interval& each : depths) {
        const double middle = random.between(-5, farthest);
        const double half = random.unit() < 0.05 ? random.between(0, farthest) : random.between(0.1, 4);
        each = {static_cast<double>(static_cast<float>(middle - half)),
                static_cast<double>(static_cast<float>(middle + half))};
    }
    return depths;
}

constexpr std::uint32_t kCounts[] = {1u, 2u, 15u, 16u, 17u, 100u, 1000u, 5000u};

TEST(SortRecords, KeepsEachLightOnceInTheOrderOfDepths) {
    for (const std::uint32_t count : kCounts) {
        const auto depths = random_depths(count, 200.0);
        const TileOfCells tile(depths);
        std::vector<bool> seen(count, false);
        double least = 1e300;
        double most = -1e300;
        for (const Interval& each : depths) {
            least = std::min(least, each.low + each.high);
            most = std::max(most, each.low + each.high);
        }
        const double bin = (most - least) / std::min(std::max(count, 16u) - 1.0, 4095.0);
        double last = -1e300;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t light = tile.sorted.light[i];
            ASSERT_FALSE(seen[light]);
            seen[light] = true;
            ASSERT_EQ(static_cast<double>(tile.sorted.low[i]), depths[light].low);
            ASSERT_EQ(static_cast<double>(tile.sorted.high[i]), depths[light].high);
            ASSERT_GE(depths[light].low + depths[light].high, last - bin * 1.001);
            last = std::max(last, depths[light].low + depths[light].high);
        }
    }
}

// Endless depths among them: nothing is lost, whatever the order.
TEST(SortRecords, TakesEveryDepth) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kMost = std::numeric_limits<float>::max();
    TileOfCells tile(
        {{-kInfinity, kInfinity}, {1, 2}, {-kMost, kMost}, {kMost, kInfinity}, {-kInfinity, -kMost}, {3, 3}});
    std::uint32_t seen = 0;
    for (std::uint32_t i = 0; i < tile.count(); ++i) seen |= 1u << tile.sorted.light[i];
    EXPECT_EQ(seen, 63u);
}

// A slice's lights are those between slice_of of both ends, edges included.
TEST(Slices, TakeTheLightsBetweenTheSlicesOfTheirEnds) {
    for (const std::uint32_t slice_count : {1u, 2u, 16u, 17u, 128u}) {
        const Slices slices = make_slices(slice_count, 5.0f, 500.0f);
        const SliceLanes lanes = make_slice_lanes(slices, 0.1, 500.0f, 600.0f);
        auto depths = random_depths(1000, 600.0);
        for (std::uint32_t s = 1; s < slice_count; ++s) {
            const auto edge = static_cast<double>(slices.edges[s]);
            const auto before = static_cast<double>(std::nextafter(slices.edges[s], 0.0f));
            depths.insert(depths.end(), {{edge, edge}, {before, before}, {before, edge}});
        }
        TileOfCells tile(depths);
        const SliceSums sums = tile.measure(lanes);
        for (std::uint32_t s = 0; s < slice_count; ++s) {
            std::vector<std::uint32_t> expected;
            for (std::uint32_t i = 0; i < tile.count(); ++i) {
                const DepthArrays& sorted = tile.sorted;
                if (slice_of(slices, sorted.low[i]) <= s && s <= slice_of(slices, sorted.high[i]))
                    expected.push_back(sorted.light[i]);
            }
            const std::uint32_t picked = pick_slice(lanes, s, tile.sorted, sums.first[s], sums.end[s], tile.cell);
            ASSERT_EQ(sums.counts[s], expected.size()) << slice_count << " " << s;
            ASSERT_EQ(std::vector(tile.cell.light, tile.cell.light + picked), expected);
        }
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
    std::vector<float> low, high;
    std::vector<MlNode> nodes;
};

BuiltTree build_tree(std::uint32_t count, std::uint32_t leaf_size) {
    BuiltTree built;
    Random random(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const float range = random.between(0.1, 3);
        built.low.push_back(static_cast<float>(i) - range);
        built.high.push_back(static_cast<float>(i) + range);
    }
    built.nodes.resize(tree_node_count(count, leaf_size));
    std::vector<DepthSpan> heap(2 * std::size_t{tree_shape(count, leaf_size).leaf_count});
    const CellLights cell = {built.low.data(), built.high.data(), count, 100};
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
                low = std::min(low, built.low[node.first - 100 + i]);
                high = std::max(high, built.high[node.first - 100 + i]);
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
    const CellLights cell = {built.low.data(), built.high.data(), 65537, 100};
    EXPECT_EQ(write_list(cell, nodes.data()), nodes.data() + 2);
    EXPECT_EQ(ml_node_light_count(nodes[0].bits), 65535u);
    EXPECT_EQ(ml_node_light_count(nodes[1].bits), 2u);
    EXPECT_EQ(nodes[1].first, 100u + 65535u);
    EXPECT_EQ(ml_node_skip_count(nodes[0].bits), 1u);
}

// Half of a cell from 10 to 30 is 10: lights that cover less of it, on average, make a tree.
TEST(Decide, ComparesTheClippedMeanWithHalfTheCell) {
    SliceLanes lanes = make_slice_lanes(make_slices(1, 5.0f, 500.0f), 10.0, 30.0f, 0.0f);
    ASSERT_EQ(lanes.near_depth[0], 10.0f);
    ASSERT_EQ(lanes.far_depth[0], 30.0f);
    const auto prefers = [&](const std::vector<Interval>& depths) {
        TileOfCells tile(depths);
        const SliceSums sums = tile.measure(lanes);
        return prefers_tree(sums.counts[0], sums.depths[0], 10.0f, 30.0f);
    };
    EXPECT_TRUE(prefers({{15.25, 24.75}, {15.25, 24.75}}));
    EXPECT_FALSE(prefers({{15, 25}, {15, 25}})) << "strict";
    EXPECT_FALSE(prefers({{-1000, 1000}, {19, 21}})) << "clipped to 20 and 2";
    EXPECT_TRUE(prefers({{11, 29}, {19.25, 20.75}}));
    EXPECT_TRUE(prefers({{49, 51}, {49, 51}})) << "clipped to nothing";
}

} // namespace
} // namespace manylights::test
