// Fields of few bits: light counts, skip counts, padding, light indices and tile numbers.

#include "tests/property/probes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace manylights::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

oracle::Camera one_tile_camera() {
    const float eye[3] = {0.0f, 0.0f, 0.0f};
    return oracle::plain_camera(8, 8, 0.5, eye, 0.5f);
}

/// count lights around the axis of view, all of which affect (0, 0, -2); depths spread a little.
std::vector<ManylightsSphere> lights_on_the_axis(std::uint32_t count) {
    std::vector<ManylightsSphere> spheres(count);
    for (std::uint32_t i = 0; i < count; ++i)
        spheres[i] = {{0.0f, 0.0f, -2.0f - static_cast<float>(i) / static_cast<float>(count)}, 1.5f};
    return spheres;
}

void expect_each_once(std::vector<std::uint32_t> lights, std::uint32_t count) {
    ASSERT_EQ(lights.size(), count);
    std::sort(lights.begin(), lights.end());
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(lights[i], i);
}

TEST(Limits, MoreThan65535LightsInOneTileAreAllHandedOutOnce) {
    int wrapped = 0;
    for (std::uint32_t count : {65535u, 65536u, 65537u, 200000u}) {
        std::vector<ManylightsSphere> spheres = lights_on_the_axis(count);
        wrapped += (count & 0xFFFFu) != count ? 1 : 0;
        for (ManylightsStructure structure : kStructures)
            for (std::uint32_t leaf_size : {4u, 65535u}) {
                ManylightsSettings settings = default_settings(structure);
                settings.leaf_size = leaf_size;
                Frame frame(settings);
                ASSERT_TRUE(frame.build({one_tile_camera().view}, lights_of(spheres))) << frame.failure();
                SCOPED_TRACE(std::string(structure_name(structure)) + ", lights " + std::to_string(count) + ", leaf " +
                             std::to_string(leaf_size));
                expect_each_once(frame.query(0, 4.5f, 4.5f, 2.0f), count);
            }
    }
    EXPECT_EQ(wrapped, 3) << "these counts must not fit 16 bits";
}

/// Nodes that a walk at this depth reads, and where it ends.
MlUint walk_of_misses(const Frame& frame, const MlCell& cell, float depth, MlUint& end) {
    MlUint read = 0, node = cell.first;
    for (; node < cell.first + cell.count && read <= cell.count; ++read) {
        const MlNode& n = frame.buffers().nodes[node];
        bool hit = n.min_depth <= depth && depth <= n.max_depth;
        node += hit ? 1u : ml_node_skip_count(n.bits);
    }
    end = node;
    return read;
}

TEST(Limits, MissesLeadExactlyToTheEndOfTreesWithMoreLeavesThan15BitsSkip) {
    int wrapped = 0;
    for (std::uint32_t count : {1u, 2u, 3u, 16383u, 16384u, 16385u, 32768u, 70000u, 200000u}) {
        ManylightsSettings settings = default_settings(MANYLIGHTS_STRUCTURE_TREES);
        settings.leaf_size = 1;
        Frame frame(settings);
        std::vector<ManylightsSphere> spheres = lights_on_the_axis(count);
        ASSERT_TRUE(frame.build({one_tile_camera().view}, lights_of(spheres))) << frame.failure();
        const MlCell& cell = frame.buffers().cells[0];
        for (float depth : {0.0f, 0.1f, 100.0f, kInfinity, -kInfinity, kNan}) {
            MlUint end = 0;
            MlUint read = walk_of_misses(frame, cell, depth, end);
            ASSERT_EQ(end, cell.first + cell.count) << count << " lights, depth " << depth;
            ASSERT_LE(read, 16u) << "misses must be skipped at the roots";
            ASSERT_TRUE(frame.query(0, 4.5f, 4.5f, depth).empty());
        }
        for (float depth : {0.7f, 1.0f, 4.2f}) {
            MlUint end = 0;
            walk_of_misses(frame, cell, depth, end);
            ASSERT_EQ(end, cell.first + cell.count) << count << " lights, depth " << depth;
        }
        expect_each_once(frame.query(0, 4.5f, 4.5f, 2.5f), count);
        std::uint64_t nodes = 2 * static_cast<std::uint64_t>(std::bit_ceil(count)) - 1;
        wrapped += (nodes & 0x7FFFu) != nodes ? 1 : 0;
    }
    EXPECT_EQ(wrapped, 4) << "one light per leaf must not fit 15 bits for these counts";
}

TEST(Limits, PaddingLeavesHitNoDepthAndHoldNoLight) {
    int padding = 0;
    for (std::uint32_t count : {3u, 5u, 9u, 33u, 1234u}) {
        ManylightsSettings settings = default_settings(MANYLIGHTS_STRUCTURE_TREES);
        settings.leaf_size = 1;
        Frame frame(settings);
        std::vector<ManylightsSphere> spheres = lights_on_the_axis(count);
        ASSERT_TRUE(frame.build({one_tile_camera().view}, lights_of(spheres))) << frame.failure();
        for (std::size_t i = 0; i < frame.node_count(); ++i) {
            const MlNode& node = frame.buffers().nodes[i];
            ASSERT_LE(node.first + (ml_node_is_leaf(node.bits) ? ml_node_light_count(node.bits) : 0u),
                      frame.reference_count());
            if (!ml_node_is_leaf(node.bits) || ml_node_light_count(node.bits) != 0) continue;
            ++padding;
            for (float depth : {0.0f, -0.0f, 2.0f, 3e38f, -3e38f, kInfinity, -kInfinity, kNan})
                ASSERT_FALSE(node.min_depth <= depth && depth <= node.max_depth) << depth;
        }
        for (float depth : {0.0f, kInfinity, -kInfinity, kNan})
            EXPECT_TRUE(frame.query(0, 4.5f, 4.5f, depth).empty()) << depth;
    }
    EXPECT_GT(padding, 100);
}

TEST(Limits, ManyTilesAndManyLightsKeepTheirNumbersApart) {
    // More lights than 22 bits count, more tiles than 10 bits count: almost all lights are far behind the camera.
    constexpr std::uint32_t kLights = (1u << 22u) + 5000u, kVisible = 5000;
    const float eye[3] = {0.0f, 0.0f, 0.0f};
    oracle::Random random(16);
    Trial trial;
    trial.camera = oracle::plain_camera(3840, 2160, 0.5, eye, 0.5f);
    trial.spheres.assign(kLights - kVisible, ManylightsSphere{{0.0f, 0.0f, 1000.0f}, 1.0f});
    int high_index = 0, high_tile = 0;
    for (std::uint32_t i = 0; i < kVisible; ++i) {
        oracle::ScreenPosition screen{random.between(0, 3840), random.between(0, 2160), random.octaves(0, 6)};
        MlFloat3 point = unproject(trial.camera, screen);
        trial.spheres.push_back(light_reaching(random, eye, point, screen.depth * 0.01, 1e-3));
        std::uint32_t index = kLights - kVisible + i;
        if (!trial.add_probe(point, index)) continue;
        high_index += index >= 1u << 22u ? 1 : 0;
        high_tile += static_cast<int>(screen.y / 16.0) * 240 + static_cast<int>(screen.x / 16.0) >= 1024 ? 1 : 0;
    }
    ManylightsSettings settings = default_settings();
    settings.tile_px = 16;
    Outcome outcome;
    expect_none_lost(trial, settings, outcome);
    EXPECT_GT(outcome.triples, 4000u);
    EXPECT_GT(high_index, 4000) << "indices must not fit 22 bits";
    EXPECT_GT(high_tile, 4000) << "tile numbers must not fit 10 bits";
}

TEST(Limits, EveryCountAndImageSizeThatIsAwkward) {
    oracle::Random random(1);
    const float eye[3] = {0.0f, 0.0f, 0.0f};
    std::uint64_t triples = 0;
    for (auto [width, height] : {std::pair{1u, 1u}, std::pair{47u, 33u}, std::pair{48u, 48u}, std::pair{49u, 97u}})
        for (int count : {0, 1, 31, 32, 33, 1234}) {
            Trial trial;
            trial.camera = oracle::plain_camera(width, height, 0.5, eye, 0.5f);
            for (int i = 0; i < count; ++i) {
                oracle::ScreenPosition screen{random.between(0, width), random.between(0, height),
                                              random.octaves(-2, 9)};
                MlFloat3 point = unproject(trial.camera, screen);
                trial.spheres.push_back(light_reaching(random, eye, point, screen.depth * random.octaves(-5, 0), 1e-5));
                trial.add_probe(point, static_cast<std::uint32_t>(i));
            }
            Outcome outcome;
            expect_none_lost(trial, default_settings(), outcome);
            EXPECT_GE(outcome.triples * 10, static_cast<std::uint64_t>(count) * 9);
            triples += outcome.triples;
        }
    EXPECT_GT(triples, 4000u);
}

} // namespace
} // namespace manylights::test
