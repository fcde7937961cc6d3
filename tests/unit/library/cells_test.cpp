// Structures with depth slices: depth codes, the order of lights, dealing them to cells, and the decision.

#include "src/build/builder.h"
#include "src/build/cells.h"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace manylights::test {
namespace {

using namespace detail;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// One block of lights, all in the image's first pixel.
struct Block {
    std::vector<float> zeros, depth, radius;
    std::vector<std::uint32_t> index, pixels, bands;
    std::vector<LightBox> boxes;

    LightBlock lights() {
        const auto count = static_cast<std::uint32_t>(depth.size());
        for (auto* each : {&depth, &radius, &zeros}) each->resize(count + kLanePadding);
        for (auto* each : {&index, &pixels, &bands}) each->resize(count + kLanePadding);
        boxes.resize(count + kLanePadding);
        return {zeros.data(), zeros.data(),  depth.data(),  radius.data(),
                index.data(), pixels.data(), pixels.data(), count};
    }
};

TEST(DepthCodes, RoundOutwardByAHundredthOfTheLight) {
    const std::vector<std::uint32_t> steps(kBandSteps + 1, 0);
    const Slices slices = make_slices(16, 5.0f, 500.0f);
    for (const float top : {1e-20f, 1.0f, 700.0f, 3e37f}) {
        Block block;
        Random random(1);
        for (int i = 0; i < 5000; ++i) {
            block.depth.push_back(top * std::exp2(-random.between(0, 15)));
            block.radius.push_back(block.depth.back() * std::exp2(-random.between(1, 16)));
        }
        // At the ends, and beyond them.
        for (const float depth : {top, 0.0f, -top, top * 1e-6f}) {
            block.depth.push_back(depth);
            block.radius.push_back(0.0f);
        }
        block.depth.push_back(top);
        block.radius.push_back(std::numeric_limits<float>::max());
        const LightBlock lights = block.lights();
        const DepthCodes codes = make_depth_codes(top * 0x1p-15f, top);
        const BoxView view = {32, 1, 1, 0, &slices, codes, {0, 1, kInfinity, codes, steps.data()}};
        BoxSums sums{};
        box_block(view, lights, {block.boxes.data(), block.bands.data()}, sums);
        for (std::uint32_t i = 0; i < lights.count; ++i) {
            const float low = codes.low_of(block.boxes[i].span);
            const float high = codes.high_of(block.boxes[i].span);
            ASSERT_LE(low, block.depth[i] - block.radius[i]) << top << " " << i;
            ASSERT_GE(high, block.depth[i] + block.radius[i]) << top << " " << i;
            if (i >= 5000) continue;
            // 2^-16 of the depth, and 2^-7 of the extent.
            const float slack = 2e-5f * block.depth[i] + 0.02f * block.radius[i];
            ASSERT_GE(low, block.depth[i] - block.radius[i] - slack) << top << " " << i;
            ASSERT_LE(high, block.depth[i] + block.radius[i] + slack) << top << " " << i;
        }
        EXPECT_GE(codes.low_of(block.boxes[5000].span), top * 0.99998f);
        EXPECT_EQ(codes.low_of(block.boxes[5001].span), -kInfinity) << "nearer than all codes";
        EXPECT_EQ(codes.low_of(block.boxes[5002].span), -kInfinity);
        EXPECT_EQ(codes.high_of(block.boxes[5004].span), kInfinity) << "longer than all codes";
        EXPECT_GE(sums.farthest, std::numeric_limits<float>::max());
    }
}

// Slices, and how many cells there are, by the decoded depths; edges included.
TEST(Boxes, ReachTheSlicesOfTheirDepths) {
    const std::vector<std::uint32_t> steps(kBandSteps + 1, 0);
    for (const std::uint32_t slice_count : {1u, 2u, 16u, 17u, 128u}) {
        const Slices slices = make_slices(slice_count, 5.0f, 500.0f);
        Block block;
        Random random(slice_count);
        for (int i = 0; i < 2000; ++i) {
            block.depth.push_back(random.between(-5, 600));
            block.radius.push_back(random.unit() < 0.05 ? random.between(0, 600) : random.between(0.01, 4));
        }
        for (std::uint32_t s = 1; s < slice_count; ++s) {
            block.depth.push_back(slices.edges[s]);
            block.radius.push_back(0.0f);
        }
        const LightBlock lights = block.lights();
        const DepthCodes codes = make_depth_codes(1.0f, 700.0f);
        constexpr std::uint32_t kTiles = 1000;
        const BoxView view = {32, 40, kTiles, 7, &slices, codes, {0, 1, kInfinity, codes, steps.data()}};
        BoxSums sums{};
        box_block(view, lights, {block.boxes.data(), block.bands.data()}, sums);
        std::uint64_t cells = 0;
        for (std::uint32_t i = 0; i < lights.count; ++i) {
            const LightBox& box = block.boxes[i];
            const std::uint32_t first = slice_of(slices, codes.low_of(box.span));
            const std::uint32_t last = slice_of(slices, codes.high_of(box.span));
            ASSERT_EQ(box.first_cell, 7 + first * kTiles) << slice_count << " " << i;
            cells += last - first + 1;
        }
        EXPECT_EQ(sums.cells, cells);
    }
}

void call_in_order(void*, std::uint32_t count, ManylightsTask task, void* context) {
    for (std::uint32_t i = 0; i < count; ++i) task(context, i);
}

BuilderPtr cell_builder(std::uint32_t structure, std::uint32_t workers, std::uint32_t tile_px) {
    ManylightsSettings settings = settings_of(structure);
    settings.max_workers = workers;
    settings.parallel_for = workers > 1 ? call_in_order : nullptr;
    settings.tile_px = tile_px;
    return make_builder(settings);
}

// The cells that a box says, and the ranks in each.
std::map<std::uint32_t, std::vector<std::uint32_t>> expected_ranks(const ManylightsBuilder& builder) {
    const Cells& cells = builder.cells;
    std::map<std::uint32_t, std::vector<std::uint32_t>> expected;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        const DepthCodes& codes = cells.codes[v];
        for (std::uint32_t rank = cells.first_light[v]; rank < cells.first_light[v + 1]; ++rank) {
            const LightBox& box = cells.boxes[rank];
            const std::uint32_t first = slice_of(builder.slices, codes.low_of(box.span));
            const std::uint32_t last = slice_of(builder.slices, codes.high_of(box.span));
            for (std::uint32_t s = 0; s <= last - first; ++s)
                for (std::uint32_t y = 0; y <= box.tiles >> 16; ++y)
                    for (std::uint32_t x = 0; x <= (box.tiles & 0xFFFF); ++x)
                        expected[box.first_cell + s * static_cast<std::uint32_t>(grid.tile_count) + y * grid.tiles_x +
                                 x]
                            .push_back(rank);
        }
    }
    return expected;
}

// Each light is in each cell of its box once, in the order of ranks but for those that are dealt together.
void expect_dealt(const ManylightsBuilder& builder, const Frame& frame) {
    const auto expected = expected_ranks(builder);
    std::size_t references = 0;
    for (const auto& [cell, ranks] : expected) {
        std::vector<std::uint32_t> lights;
        for (const std::uint32_t rank : ranks) lights.push_back(builder.cells.boxes[rank].light);
        std::vector<MlUint> dealt = lights_of_cell(frame, cell);
        ASSERT_EQ(dealt.size(), lights.size()) << cell;
        for (std::size_t i = 0; i < dealt.size(); ++i) {
            const auto found = std::find(lights.begin(), lights.end(), dealt[i]);
            ASSERT_NE(found, lights.end()) << cell;
            ASSERT_LT(std::abs(found - lights.begin() - static_cast<std::ptrdiff_t>(i)), kDealtTogether) << cell;
        }
        std::sort(dealt.begin(), dealt.end());
        std::sort(lights.begin(), lights.end());
        ASSERT_EQ(dealt, lights) << cell;
        references += ranks.size();
    }
    EXPECT_EQ(frame.references.size(), references);
}

// Without homes, with them, and where the lights jump: some of a cell's are in its home and some in chunks behind it.
// Tiles so small that boxes have more columns than a vector has lanes, too.
TEST(Deal, PutsEachLightIntoTheCellsOfItsBox) {
    for (const std::uint32_t workers : {1u, 3u}) {
        for (const std::uint32_t tile_px : {8u, 48u}) {
            const BuilderPtr builder = cell_builder(MANYLIGHTS_STRUCTURE_LISTS, workers, tile_px);
            const std::vector<ManylightsSphere> near_lights = make_lights(20000, 1, 30.0, 0.2, 3.0);
            std::vector<ManylightsSphere> far_lights = make_lights(20000, 2, 200.0, 0.5, 9.0);
            far_lights.push_back({{0, 0, 0}, 1000.0f});
            for (const bool jumps : {false, false, true, false}) {
                const Frame frame = build_frame(builder.get(), {make_view(), make_view({.yaw = 1.0})},
                                                jumps ? far_lights : near_lights);
                expect_dealt(*builder, frame);
                if (HasFatalFailure()) return;
            }
            EXPECT_EQ(builder->cells.pools.size(), workers);
        }
    }
}

// A few lights without end are no reason to see the others' depths less sharply.
TEST(DepthCodes, AreNotMadeForTheFewFarthest) {
    std::vector<ManylightsSphere> spheres = make_lights(2000, 5, 100.0, 0.5, 2.0);
    const auto references = [&](std::uint32_t structure) {
        const BuilderPtr builder = cell_builder(structure, 1, 48);
        return build_frame(builder.get(), {make_view()}, spheres).references.size();
    };
    const std::size_t without = references(MANYLIGHTS_STRUCTURE_LISTS);
    for (const float far : {1e5f, 1e18f, 1e30f}) {
        spheres.resize(2000);
        spheres.push_back({{0.0f, 0.0f, -far}, 0.5f * far});
        const std::size_t one_slice = references(MANYLIGHTS_STRUCTURE_TREES) - [&] {
            std::vector<ManylightsSphere> kept(spheres.begin(), spheres.begin() + 2000);
            std::swap(kept, spheres);
            const std::size_t count = references(MANYLIGHTS_STRUCTURE_TREES);
            std::swap(kept, spheres);
            return count;
        }();
        EXPECT_EQ(references(MANYLIGHTS_STRUCTURE_LISTS), without + one_slice) << far;
    }
}

// Every visible light once, the few large ones first, the others by depth: nearly, for those of a band keep their
// order.
TEST(Order, PutsTheLargeOnesFirstAndTheOthersByDepth) {
    const BuilderPtr builder = cell_builder(MANYLIGHTS_STRUCTURE_TREES, 1, 48);
    auto spheres = make_lights(60000, 3, 100.0, 0.1, 1.9);
    for (const ManylightsSphere& large : make_lights(300, 4, 100.0, 20.0, 30.0)) spheres.push_back(large);
    build_frame(builder.get(), {make_view()}, spheres);
    const Cells& cells = builder->cells;
    std::vector<bool> seen(spheres.size(), false);
    float deepest = -1000.0f;
    int large_count = 0;
    int inversions = 0;
    for (std::uint32_t rank = 0; rank < cells.first_light[1]; ++rank) {
        const std::uint32_t light = cells.boxes[rank].light;
        ASSERT_FALSE(seen[light]);
        seen[light] = true;
        if (light >= 60000) {
            ASSERT_EQ(deepest, -1000.0f);
            ++large_count;
            continue;
        }
        const float depth = std::max(-spheres[light].center[2], 0.0f); // behind the camera in any order
        ASSERT_GE(depth, 0.95f * deepest) << "a band is a 32nd of an octave at the most";
        inversions += depth < 0.99f * deepest ? 1 : 0;
        deepest = std::max(deepest, depth);
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), builder->stats.visible_lights);
    EXPECT_GT(large_count, 50);
    EXPECT_LT(inversions, static_cast<int>(cells.first_light[1] / 20));
}

// Half of a cell from 10 to 30 is 10: lights that cover less of it, on average, make a tree.
TEST(Decide, ComparesTheClippedMeanWithHalfTheCell) {
    ManylightsSettings settings = settings_of(MANYLIGHTS_STRUCTURE_HYBRID);
    settings.slice_count = 1;
    settings.slice_far = 30.0f;
    settings.leaf_size = 1;
    const BuilderPtr builder = make_builder(settings);
    const auto prefers = [&](const std::vector<std::pair<float, float>>& depths) {
        std::vector<ManylightsSphere> spheres;
        for (const auto& [low, high] : depths)
            spheres.push_back({{0.0f, 0.0f, -0.5f * (low + high)}, 0.5f * (high - low)});
        const Frame frame = build_frame(builder.get(), {make_view({.near_depth = 10.0})}, spheres);
        const MlView& view = frame.views[0];
        const std::uint32_t middle = view.height / 2 / view.tile_px * view.tiles_x + view.width / 2 / view.tile_px;
        EXPECT_EQ(lights_of_cell(frame, middle).size(), depths.size());
        return frame.cells[middle].count > 1; // nodes
    };
    EXPECT_TRUE(prefers({{15.25f, 24.75f}, {15.25f, 24.75f}}));
    EXPECT_FALSE(prefers({{14.9f, 25.1f}, {14.9f, 25.1f}}));
    EXPECT_FALSE(prefers({{-1000.0f, 1000.0f}, {19.0f, 21.0f}})) << "clipped to 20 and 2";
    EXPECT_TRUE(prefers({{11.0f, 29.0f}, {19.25f, 20.75f}}));
    EXPECT_TRUE(prefers({{9.0f, 12.0f}, {9.5f, 12.0f}})) << "clipped to 2 each";
}

} // namespace
} // namespace manylights::test
