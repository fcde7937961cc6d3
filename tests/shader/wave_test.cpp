// The wave cursor over handmade windows: nothing is lost, nothing comes twice, and what no point can need is left out.

#include "reference/oracle/random.h"
#include "tests/shader/handmade_windows.h"
#include "tests/shader/wave_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>

namespace manylights::test {
namespace {

constexpr float kScale = 8.0f; // codes are eighths

struct LanePoint {
    MlUint x = 0, y = 0, code = 0; ///< the pixel in the image
    bool is_there = true;
};

/// What one lane was handed. shared: by batches that all of the wave had.
struct Handed {
    std::vector<MlUint> lights, shared;
    MlUint tested = 0, references = 0, nodes = 0;
    int reads_outside = 0;
};

Handed walk_lane(WaveGroup& group, MlUint index, const LanePoint& point) {
    WaveLane lane{group, index};
    const MlFloat2 center{static_cast<float>(point.x) + 0.5f, static_cast<float>(point.y) + 0.5f};
    WaveLane::MlWaveCursor cursor =
        lane.ml_wave_begin(group.buffers.frame_view, center, static_cast<float>(point.code) / kScale, point.is_there);
    Handed handed;
    MlUint light;
    while (lane.ml_wave_next_batch(cursor))
        while (lane.ml_wave_next(cursor, light)) {
            handed.lights.push_back(light);
            if (cursor.is_shared) handed.shared.push_back(light);
        }
    handed.tested = cursor.tested;
    handed.references = cursor.references;
    handed.nodes = cursor.nodes;
    handed.reads_outside = lane.reads_outside;
    return handed;
}

std::vector<Handed> walk_group(const HandmadeBuffers& buffers, const std::vector<LanePoint>& points, MlUint wave_size,
                               MlUint few) {
    WaveGroup group(buffers, static_cast<MlUint>(points.size()), wave_size, few);
    std::vector<Handed> handed(points.size());
    std::vector<std::thread> lanes;
    for (MlUint i = 0; i < points.size(); ++i)
        lanes.emplace_back([&, i] { handed[i] = walk_lane(group, i, points[i]); });
    for (std::thread& lane : lanes) lane.join();
    return handed;
}

HandmadeBuffers buffers_of(const std::vector<MadeTile>& tiles) {
    HandmadeBuffers buffers;
    append_tiles(tiles, buffers.cells, buffers.references);
    buffers.frame_view =
        windows_view(static_cast<MlUint>(tiles.size()), static_cast<MlUint>(buffers.cells.size()), kScale);
    return buffers;
}

struct Kind {
    const char* name;
    MlUint two_classes, wide;
    bool is_flat;
};
constexpr Kind kKinds[] = {{"one class", 0, 0, false},
                           {"two classes", 1, 0, false},
                           {"one class, wide", 0, 1, false},
                           {"two classes, wide", 1, 1, false},
                           {"flat", 0, 0, true}};

MadeReference made_reference(oracle::Random& random, MlUint light, const MadeTile& tile, MlUint extent) {
    const MlUint span = (tile.form.last_slice + 1) << tile.form.slice_shift;
    MadeReference r{light, tile.base_code + random.below(span), 0};
    r.high = std::min(r.low + random.below(extent), tile.base_code + span - 1);
    r.x0 = random.below(16), r.y0 = random.below(16);
    r.x1 = std::min(15u, r.x0 + random.below(8)), r.y1 = std::min(15u, r.y0 + random.below(8));
    return r;
}

// Up to 31 slices of 2^7 codes: units of small references come around twice in each, those of large ones in eight.
MadeTile made_tile(oracle::Random& random, const Kind& kind, MlUint count) {
    MadeTile tile;
    tile.base_code = 1000 + random.below(1000);
    tile.form = {7, 0, 0, random.below(31), kind.two_classes, kind.wide, kind.is_flat ? count : 0u};
    if (kind.is_flat) tile.form.slice_shift = 12, tile.form.last_slice = 0;
    tile.form.small_shift = kind.is_flat ? 6 : random.below(4);
    tile.form.large_shift = kind.two_classes != 0 ? 3 : 0;
    // The same lights in all tiles: one that a lane is handed for its neighbour's tile comes twice.
    for (MlUint i = 0; i < count; ++i) {
        const bool is_large = kind.two_classes != 0 && i % 3 == 0;
        const MlUint unit = 1u << (is_large ? tile.form.large_shift : tile.form.small_shift);
        (is_large ? tile.large : tile.small)
            .push_back(made_reference(random, i, tile, random.chance(0.2) ? 255 * unit : 20 * unit));
    }
    return tile;
}

// A few depths, each with many points around it, some before and behind all slices.
std::vector<LanePoint> made_points(oracle::Random& random, const std::vector<MadeTile>& tiles, MlUint lanes) {
    MlUint depths[3];
    for (MlUint& depth : depths) depth = 900 + random.below(6000);
    const MlUint spread = 1u << random.below(10);
    const MlUint first_x = random.below(16 * static_cast<MlUint>(tiles.size())), width = 1 + random.below(24);
    std::vector<LanePoint> points(lanes);
    for (LanePoint& point : points) {
        point.x = std::min(16 * static_cast<MlUint>(tiles.size()) - 1, first_x + random.below(width));
        point.y = random.below(16);
        point.code = depths[random.below(3)] + random.below(spread);
        point.is_there = !random.chance(0.15);
    }
    return points;
}

void expect_nothing_lost(const std::vector<MadeTile>& tiles, const LanePoint& point, const Handed& handed) {
    const std::set<MlUint> distinct(handed.lights.begin(), handed.lights.end());
    ASSERT_EQ(distinct.size(), handed.lights.size()) << "a light came twice";
    ASSERT_EQ(handed.tested, handed.lights.size());
    ASSERT_EQ(handed.reads_outside, 0);
    if (!point.is_there) {
        ASSERT_TRUE(handed.lights.empty());
        return;
    }
    for (const MlUint light : holders(tiles[point.x / 16], point.code, point.x % 16, point.y))
        ASSERT_TRUE(distinct.contains(light)) << "light " << light << " at code " << point.code;
}

TEST(Wave, LosesNothingInAnyForm) {
    oracle::Random random(21);
    for (const Kind& kind : kKinds)
        for (const MlUint wave_size : {4u, 8u, 16u, 32u, 64u})
            for (const MlUint few : {0u, 12u, 32u})
                for (int round = 0; round < 2; ++round) {
                    std::vector<MadeTile> tiles;
                    for (MlUint t = 0; t < 4; ++t)
                        tiles.push_back(made_tile(random, kKinds[random.below(5)], random.below(120)));
                    tiles[random.below(4)] = made_tile(random, kind, 1 + random.below(127));
                    const std::vector<LanePoint> points = made_points(random, tiles, 64);
                    const std::vector<Handed> handed = walk_group(buffers_of(tiles), points, wave_size, few);
                    for (std::size_t lane = 0; lane < points.size(); ++lane)
                        ASSERT_NO_FATAL_FAILURE(expect_nothing_lost(tiles, points[lane], handed[lane]))
                            << kind.name << ", wave of " << wave_size << ", few " << few << ", lane " << lane;
                }
}

TEST(Wave, TilesOfVeryManyReferencesKeepAllBitsOfTheirWindows) {
    oracle::Random random(22);
    for (const Kind& kind : {kKinds[2], kKinds[3]}) {
        const std::vector<MadeTile> tiles{made_tile(random, kind, 70000)};
        std::vector<LanePoint> points = made_points(random, tiles, 32);
        for (LanePoint& point : points) point.code = tiles[0].base_code + random.below(40);
        const std::vector<Handed> handed = walk_group(buffers_of(tiles), points, 32, 12);
        for (std::size_t lane = 0; lane < points.size(); ++lane)
            ASSERT_NO_FATAL_FAILURE(expect_nothing_lost(tiles, points[lane], handed[lane])) << kind.name;
    }
}

// Two depths, far from each other, and one column of the tile each.
std::vector<LanePoint> two_walls(MlUint near_code, MlUint far_code) {
    std::vector<LanePoint> points(32);
    for (MlUint i = 0; i < points.size(); ++i)
        points[i] = {i % 2 == 0 ? 3u : 12u, i % 16, i % 2 == 0 ? near_code : far_code, true};
    return points;
}

MadeTile tile_of_slices(MlUint slices) {
    MadeTile tile;
    tile.base_code = 1000;
    tile.form = {7, 0, 0, slices - 1, 0, 0, 0};
    return tile;
}

std::vector<MlUint> shared_by_all(const MadeTile& tile, const std::vector<LanePoint>& points) {
    const std::vector<Handed> handed = walk_group(buffers_of({tile}), points, 32, 0);
    for (const Handed& lane : handed) {
        EXPECT_EQ(lane.lights, handed.front().lights) << "not the same for all lanes";
        EXPECT_EQ(lane.shared, lane.lights);
    }
    return handed.front().lights;
}

// Depths 256 units apart look alike in the bounds; the slice of a candidate tells them apart.
TEST(Wave, LightsBetweenTheDepthsOfAWaveAreLeftOut) {
    MadeTile tile = tile_of_slices(30);
    for (MlUint i = 0; i < 30; ++i) tile.small.push_back({i, 1000 + 128 * i + 5, 1000 + 128 * i + 9});
    EXPECT_EQ(shared_by_all(tile, two_walls(1007, 1000 + 128 * 29 + 7)), (std::vector<MlUint>{0, 29}));
    EXPECT_EQ(shared_by_all(tile, two_walls(1000 + 128 * 4 + 7, 1000 + 128 * 20 + 7)), (std::vector<MlUint>{4, 20}));
}

// One that begins before the wave's first slice reaches what its extent says, and no more.
TEST(Wave, LightsThatBeginBeforeTheWaveReachAsFarAsTheyDo) {
    MadeTile tile = tile_of_slices(30);
    tile.small = {{1, 1000, 1255}, {2, 1000, 1253}, {3, 1020, 1254}, {4, 1100, 1254 + 100}, {5, 1000, 1010}};
    EXPECT_EQ(shared_by_all(tile, two_walls(1254, 1000 + 128 * 20)), (std::vector<MlUint>{1, 3, 4}));
    EXPECT_EQ(shared_by_all(tile, two_walls(1255, 1256)), (std::vector<MlUint>{1, 4}));
}

TEST(Wave, LightsBesideThePixelsOfAWaveAreLeftOut) {
    MadeTile tile = tile_of_slices(2);
    tile.small = {{1, 1000, 1100, 0, 2, 0, 15},
                  {2, 1000, 1100, 4, 11, 0, 15},
                  {3, 1000, 1100, 3, 3, 0, 0},
                  {4, 1000, 1100, 12, 15, 9, 9},
                  {5, 1000, 1100, 0, 15, 3, 4}};
    std::vector<LanePoint> points = two_walls(1050, 1060);
    for (LanePoint& point : points) point.y = point.y < 8 ? 0 : 9;
    EXPECT_EQ(shared_by_all(tile, points), (std::vector<MlUint>{3, 4}));
}

// A slice of more units than eight bits hold tells nothing of where in it a light begins: all of them are handed out.
TEST(Wave, DepthsThatNothingTellsAreTakenForAll) {
    MadeTile tile = tile_of_slices(2);
    tile.form.slice_shift = 10;
    for (MlUint i = 0; i < 8; ++i) tile.small.push_back({i, 1000 + 256 * i, 1000 + 256 * i + 10});
    const std::vector<MlUint> lights = shared_by_all(tile, two_walls(1005, 1000 + 256 * 7 + 5));
    EXPECT_EQ(lights.size(), 8u);
}

// Fewer candidates than ML_WAVE_FEW: what a lane's own cursor hands out, in the same order.
TEST(Wave, FewCandidatesArePickedByEachLane) {
    oracle::Random random(23);
    for (const Kind& kind : kKinds) {
        const MadeTile tile = made_tile(random, kind, 31);
        std::vector<LanePoint> points = made_points(random, {tile}, 32);
        const MlUint code = tile.base_code + random.below((tile.form.last_slice + 1) << tile.form.slice_shift);
        for (LanePoint& point : points) point.code = code;
        HandmadeBuffers buffers = buffers_of({tile});
        const std::vector<Handed> handed = walk_group(buffers, points, 32, 32);
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_TRUE(handed[i].shared.empty());
            const std::vector<MlUint> own = candidates(tile, code, points[i].x, points[i].y);
            EXPECT_EQ(handed[i].lights, points[i].is_there ? own : std::vector<MlUint>{}) << kind.name;
            EXPECT_EQ(handed[i].references, compared(tile, code));
        }
    }
}

TEST(Wave, PartsOfThousandsOfCandidatesComeInBatchesOfTheWave) {
    MadeTile tile = tile_of_slices(4);
    for (MlUint i = 0; i < 1000; ++i) tile.small.push_back({i, 1000 + i % 300, 1000 + i % 300 + 100});
    for (const MlUint wave_size : {4u, 64u}) {
        const std::vector<LanePoint> points(64, LanePoint{5, 5, 1150, true});
        const std::vector<Handed> handed = walk_group(buffers_of({tile}), points, wave_size, 0);
        EXPECT_EQ(handed[0].lights, holders(tile, 1150, 5, 5));
        EXPECT_EQ(handed[63].lights, handed[0].lights);
        EXPECT_LE(handed[1].references, 1000 / wave_size + 1);
    }
}

TEST(Wave, WithoutAnyPointNothingIsRead) {
    oracle::Random random(24);
    std::vector<LanePoint> points(32);
    for (LanePoint& point : points) point.is_there = false;
    for (const Handed& lane : walk_group(buffers_of({made_tile(random, kKinds[1], 90)}), points, 8, 12)) {
        EXPECT_TRUE(lane.lights.empty());
        EXPECT_EQ(lane.nodes + lane.references, 0u);
    }
}

} // namespace
} // namespace manylights::test
