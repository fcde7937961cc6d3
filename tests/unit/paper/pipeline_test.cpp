// What the switches do, and where packed fields end.

#include "tests/unit/paper/cases.h"
#include "tests/unit/paper/reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace manylights::paper {
namespace {

struct Work {
    std::uint64_t tested = 0, nodes = 0;
};

Work work(const Buffers& frame, const std::vector<PointCase>& points) {
    Work sum;
    Reader reader(frame);
    for (const PointCase& point : points) {
        const auto answer = reader.ask(0, point.position, point.depth);
        sum.tested += answer.lights.size();
        sum.nodes += answer.nodes;
    }
    return sum;
}

class Switches : public ::testing::Test {
  protected:
    const CameraCase camera_{};
    const ManylightsView view_ = make_view(camera_);
    const std::vector<ManylightsSphere> lights_ = random_lights(20000, 1);
    const std::vector<PointCase> points_ = points_in_lights(camera_, lights_, 2000, 2);

    Work work_with(const Options& options) {
        PaperPipeline pipeline;
        return work(pipeline.build({&view_, 1}, lights_of(lights_), options), points_);
    }
};

TEST_F(Switches, AlwaysListTestsWhatClusteredTests) {
    const Work lists = work_with({.heuristic = Heuristic::always_list});
    const Work clustered = work_with({.structure = Structure::clustered});
    EXPECT_EQ(lists.tested, clustered.tested);
    EXPECT_EQ(lists.nodes, 2 * points_.size()) << "a cell and the list's node";
    EXPECT_EQ(clustered.nodes, points_.size()) << "a cell";
}

// One light at depth 100, asked for at 95: in its slice, [79.2, 107.7), but in front of it.
TEST_F(Switches, ListBoundsDecideWhetherAListIsEntered) {
    const MlFloat3 ahead = ahead_of(camera_);
    const std::vector<ManylightsSphere> one{
        {{camera_.position[0] + 100.0f * ahead.x, camera_.position[1] + 100.0f * ahead.y,
          camera_.position[2] + 100.0f * ahead.z},
         3.0f}};
    PaperPipeline pipeline;
    const auto tested = [&](ListBounds bounds, float depth) {
        Reader reader(pipeline.build({&view_, 1}, lights_of(one), {.list_bounds = bounds}));
        return reader.ask(0, {320.5f, 180.5f}, depth).lights.size();
    };
    EXPECT_EQ(tested(ListBounds::infinite, 95.0f), 1u);
    EXPECT_EQ(tested(ListBounds::of_lights, 95.0f), 0u);
    EXPECT_EQ(tested(ListBounds::of_lights, 98.0f), 1u);
}

TEST_F(Switches, TreesTestFewerLightsThanLists) {
    const std::uint64_t lists = work_with({.structure = Structure::clustered}).tested;
    const std::uint64_t hybrid = work_with({}).tested;
    const std::uint64_t all_trees = work_with({.heuristic = Heuristic::always_tree}).tested;
    EXPECT_LT(hybrid, lists);
    EXPECT_LE(all_trees, hybrid);
    EXPECT_LT(work_with({.structure = Structure::tree}).tested, lists);
}

TEST_F(Switches, SmallerLeavesTestFewerLightsWithMoreNodes) {
    const Work one = work_with({.structure = Structure::tree, .leaf_size = 1});
    const Work sixteen = work_with({.structure = Structure::tree, .leaf_size = 16});
    EXPECT_LT(one.tested, sixteen.tested);
    EXPECT_GT(one.nodes, sixteen.nodes);
}

TEST_F(Switches, PrintedListing4TestsMoreLights) {
    const Work printed =
        work_with({.structure = Structure::clustered, .slice_formula = SliceFormula::listing4_as_printed});
    EXPECT_GT(printed.tested, 2 * work_with({.structure = Structure::clustered}).tested);
}

TEST_F(Switches, ReadingsOfTheRadiusOrderTheNumberOfTrees) {
    PaperPipeline pipeline;
    const auto trees = [&](Heuristic heuristic) {
        return pipeline.build({&view_, 1}, lights_of(lights_), {.heuristic = heuristic}).tree_cells;
    };
    EXPECT_EQ(trees(Heuristic::always_list), 0u);
    EXPECT_LT(trees(Heuristic::clipped_half_extent), trees(Heuristic::clipped_extent));
    EXPECT_LE(trees(Heuristic::clipped_extent), trees(Heuristic::always_tree));
    EXPECT_LT(trees(Heuristic::diameter_extent), trees(Heuristic::always_tree));
    EXPECT_GT(trees(Heuristic::expected_cost), 0u);
}

TEST_F(Switches, SortKeysDifferInOrderOnly) {
    PaperPipeline center, near_end;
    const Buffers& a = center.build({&view_, 1}, lights_of(lights_), {.structure = Structure::tree});
    const Buffers& b = near_end.build({&view_, 1}, lights_of(lights_),
                                      {.structure = Structure::tree, .sort_key = SortKey::near_depth});
    ASSERT_EQ(a.references.size(), b.references.size());
    EXPECT_FALSE(std::equal(a.references.begin(), a.references.end(), b.references.begin()));
    std::vector<std::uint32_t> sorted_a(a.references.begin(), a.references.end());
    std::vector<std::uint32_t> sorted_b(b.references.begin(), b.references.end());
    std::sort(sorted_a.begin(), sorted_a.end());
    std::sort(sorted_b.begin(), sorted_b.end());
    EXPECT_EQ(sorted_a, sorted_b);
}

// The same lights in each cell, in nearly the same order: a depth range's middle is the centre but for rounding.
TEST_F(Switches, SortedCellsAreThoseOfSortedLights) {
    for (const SortKey key : {SortKey::center_depth, SortKey::near_depth}) {
        PaperPipeline all, each;
        const Buffers& a = all.build({&view_, 1}, lights_of(lights_), {.structure = Structure::tree, .sort_key = key});
        const Buffers& b =
            each.build({&view_, 1}, lights_of(lights_),
                       {.structure = Structure::tree, .sort_key = key, .sort_scope = SortScope::each_cell});
        ASSERT_EQ(a.references.size(), b.references.size());
        std::size_t same = 0;
        for (std::size_t i = 0; i < a.references.size(); ++i) same += a.references[i] == b.references[i];
        EXPECT_GT(double(same), 0.98 * double(a.references.size()));
        EXPECT_EQ(a.nodes.size(), b.nodes.size());
    }
}

TEST_F(Switches, SortedCellsPruneAndUnsortedOnesWouldNot) {
    const Work all = work_with({.structure = Structure::tree});
    const Work each = work_with({.structure = Structure::tree, .sort_scope = SortScope::each_cell});
    EXPECT_NEAR(double(each.tested), double(all.tested), 0.01 * double(all.tested));
}

TEST_F(Switches, TopDownTreesTestFewerLights) {
    for (const std::uint32_t leaf_size : {1u, 4u, 16u}) {
        const Work up = work_with({.structure = Structure::tree, .leaf_size = leaf_size});
        const Work down =
            work_with({.structure = Structure::tree, .leaf_size = leaf_size, .tree_build = TreeBuild::top_down});
        EXPECT_LE(down.tested, up.tested) << leaf_size;
    }
}

// The lights tested are those of the walk from the root; the nodes above the entry are not visited.
TEST_F(Switches, EntriesPerSliceVisitFewerNodes) {
    for (const std::uint32_t slices : {1u, 16u, 128u}) {
        const Work root = work_with({.structure = Structure::tree});
        const Work entry =
            work_with({.structure = Structure::tree, .slice_count = slices, .tree_entry = TreeEntry::per_slice});
        EXPECT_EQ(entry.tested, root.tested);
        EXPECT_LE(entry.nodes, root.nodes);
        EXPECT_TRUE(slices == 1 || entry.nodes < root.nodes);
    }
}

TEST_F(Switches, MemoryOfEarlierFramesDoesNotShow) {
    PaperPipeline used;
    used.build({&view_, 1}, lights_of(lights_), {.structure = Structure::tree, .leaf_size = 1});
    used.build({&view_, 1}, lights_of({}), {});
    const Buffers& a = used.build({&view_, 1}, lights_of(lights_), {});
    PaperPipeline fresh;
    const Buffers& b = fresh.build({&view_, 1}, lights_of(lights_), {});
    EXPECT_TRUE(std::equal(a.references.begin(), a.references.end(), b.references.begin(), b.references.end()));
    ASSERT_EQ(a.nodes.size_bytes(), b.nodes.size_bytes());
    EXPECT_EQ(std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size_bytes()), 0);
    ASSERT_EQ(a.cells.size_bytes(), b.cells.size_bytes());
    EXPECT_EQ(std::memcmp(a.cells.data(), b.cells.data(), a.cells.size_bytes()), 0);
}

TEST_F(Switches, StagesAreTimedWhenAsked) {
    PaperPipeline pipeline;
    const StageTimes on = pipeline.build({&view_, 1}, lights_of(lights_), {.time_stages = true}).times;
    for (double stage : {on.cull, on.sort, on.bounds, on.bin, on.tree, on.pack}) EXPECT_GT(stage, 0.0);
    const StageTimes off = pipeline.build({&view_, 1}, lights_of(lights_), {}).times;
    for (double stage : {off.cull, off.sort, off.bounds, off.bin, off.tree, off.pack}) EXPECT_EQ(stage, 0.0);
}

// Card 6 of the specification: 2 * nextPow2(ceil(n / leaf)) - 1 nodes per tree, as many trees as 2^14 leaves demand; 16
// bits count at most 65,535 lights of a list's leaf.
TEST(Limits, MoreLightsInATileThanPackedFieldsHold) {
    const CameraCase camera{.yaw = 0.0, .pitch = 0.0, .width = 8, .height = 8};
    const ManylightsView view = make_view(camera);
    PaperPipeline pipeline;
    for (std::uint32_t count : {65535u, 65536u, 65537u, 200000u}) {
        SCOPED_TRACE(count);
        std::vector<ManylightsSphere> lights(count, {{3.0f, 20.0f, 150.0f}, 10.0f}); // at depth 100
        for (std::uint32_t i = 0; i < count; ++i) lights[i].center[2] -= float(i % 1000) * 0.001f;
        const std::uint32_t trees = (count + 16383) / 16384;
        struct Expected {
            Options options;
            std::size_t nodes;
        };
        const std::uint32_t rest = count - (trees - 1) * 16384; // lights of the last tree
        const Expected cases[] = {{{.structure = Structure::clustered, .slice_count = 1}, 0},
                                  {{.slice_count = 1, .heuristic = Heuristic::always_list}, (count + 65534) / 65535},
                                  {{.structure = Structure::tree, .leaf_size = 65535},
                                   count <= 65535 ? 1u : 2 * std::bit_ceil((count + 65534) / 65535) - 1},
                                  {{.structure = Structure::tree, .leaf_size = 1},
                                   (trees - 1) * std::size_t{32767} + 2 * std::bit_ceil(rest) - 1}};
        for (const Expected& test : cases) {
            const Buffers& frame = pipeline.build({&view, 1}, lights_of(lights), test.options);
            EXPECT_EQ(frame.nodes.size(), test.nodes);
            Reader reader(frame);
            auto answer = reader.ask(0, {4.5f, 4.5f}, 100.5f).lights;
            std::sort(answer.begin(), answer.end());
            EXPECT_EQ(answer.size(), count);
            EXPECT_EQ(std::unique(answer.begin(), answer.end()), answer.end());
            if (test.options.structure == Structure::tree) {
                EXPECT_TRUE(reader.ask(0, {4, 4}, 50.0f).lights.empty());
            }
        }
    }
}

TEST(Refusals, CamerasAndOptions) {
    const ManylightsView good = make_view({});
    PaperPipeline pipeline;
    const auto refuses = [&](const ManylightsView& view, const Options& options) {
        EXPECT_THROW(pipeline.build({&view, 1}, lights_of({}), options), std::invalid_argument);
    };
    ManylightsView orthographic = good;
    orthographic.clip_from_view[11] = 0.0f;
    orthographic.clip_from_view[15] = 1.0f;
    refuses(orthographic, {});
    ManylightsView flat = good;
    flat.clip_from_view[0] = 0.0f;
    refuses(flat, {});
    ManylightsView empty = good;
    empty.width = 0;
    refuses(empty, {});
    refuses(good, {.tile_px = 0});
    refuses(good, {.leaf_size = 0});
    EXPECT_NO_THROW(pipeline.build({&good, 1}, lights_of({}), {}));
}

} // namespace
} // namespace manylights::paper
