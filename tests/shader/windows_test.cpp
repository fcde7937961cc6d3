// ml_begin and ml_next over handmade windows, against the rule read plainly.

#include "reference/oracle/random.h"
#include "tests/shader/handmade_windows.h"
#include "tests/shader/shader_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace manylights::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kScale = 8.0f; // codes are eighths

HandmadeBuffers buffers_of(const std::vector<MadeTile>& tiles) {
    HandmadeBuffers buffers;
    append_tiles(tiles, buffers.cells, buffers.references);
    buffers.frame_view =
        windows_view(static_cast<MlUint>(tiles.size()), static_cast<MlUint>(buffers.cells.size()), kScale);
    return buffers;
}

float depth_of(MlUint code) { return static_cast<float>(code) / kScale; }

Walk walk_at(HandmadeBuffers& buffers, MlUint code, MlUint x, MlUint y) {
    return walk(buffers, depth_of(code), {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
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

MadeReference made_reference(oracle::Random& random, MlUint light, MlUint base, MlUint span, MlUint extent) {
    MadeReference r{light, base + random.below(span), 0};
    r.high = std::min(r.low + random.below(extent), base + span - 1);
    r.x0 = random.below(16), r.y0 = random.below(16);
    r.x1 = r.x0 + random.below(16 - r.x0), r.y1 = r.y0 + random.below(16 - r.y0);
    return r;
}

// Codes from base to base + slices * 2^slice_shift; small references span up to 40 codes, large ones up to 600.
MadeTile made_tile(oracle::Random& random, const Kind& kind, MlUint count, MlUint slices) {
    MadeTile tile;
    tile.base_code = 1000 + random.below(1000);
    tile.form = {5, 0, 0, slices - 1, kind.two_classes, kind.wide, kind.is_flat ? count : 0u};
    if (kind.is_flat) tile.form.slice_shift = 12, tile.form.last_slice = 0;
    const MlUint span = (tile.form.last_slice + 1) << tile.form.slice_shift;
    tile.form.small_shift = kind.two_classes != 0 ? 1 : 3;
    tile.form.large_shift = kind.two_classes != 0 ? 3 : 0;
    for (MlUint i = 0; i < count; ++i) {
        const bool is_large = i % 3 == 0;
        const MadeReference r = made_reference(random, 7 * i + 1, tile.base_code, span, is_large ? 600 : 40);
        (is_large && kind.two_classes != 0 ? tile.large : tile.small).push_back(r);
    }
    return tile;
}

bool has_all(const std::vector<MlUint>& lights, const std::vector<MlUint>& wanted) {
    return std::ranges::all_of(wanted, [&](MlUint light) { return std::ranges::count(lights, light) == 1; });
}

void expect_rule(HandmadeBuffers& buffers, const MadeTile& tile, MlUint code, const std::string& what) {
    for (const MlUint pixel : {0u, 3u, 8u, 15u}) {
        const Walk result = walk_at(buffers, code, pixel, 15 - pixel);
        ASSERT_EQ(result.lights, candidates(tile, code, pixel, 15 - pixel)) << what << ", code " << code;
        ASSERT_TRUE(has_all(result.lights, holders(tile, code, pixel, 15 - pixel))) << what << ", code " << code;
        ASSERT_EQ(result.references, compared(tile, code)) << what << ", code " << code;
    }
}

TEST(Windows, EveryFormHandsOutWhatTheRuleSaysAtEveryDepth) {
    oracle::Random random(11);
    for (const Kind& kind : kKinds)
        for (const MlUint slices : {1u, 2u, 3u, 8u, 31u})
            for (const MlUint count : {1u, 2u, 40u, 127u}) {
                const MadeTile tile = made_tile(random, kind, count, slices);
                HandmadeBuffers buffers = buffers_of({tile});
                ASSERT_EQ(buffers.cells.size(), 2 + ml_entry_cell_count(tile.form));
                const MlUint end = tile.base_code + ((tile.form.last_slice + 1) << tile.form.slice_shift);
                const MlUint step = kind.is_flat ? 7 : 1;
                for (MlUint code = tile.base_code - 40; code < end + 40; code += step)
                    ASSERT_NO_FATAL_FAILURE(expect_rule(buffers, tile, code, kind.name));
                EXPECT_EQ(buffers.reads_outside, 0);
            }
}

TEST(Windows, SlicesChangeExactlyAtTheirEdges) {
    oracle::Random random(12);
    for (const Kind& kind : kKinds) {
        const MadeTile tile = made_tile(random, kind, 100, 9);
        HandmadeBuffers buffers = buffers_of({tile});
        for (MlUint slice = 0; slice <= tile.form.last_slice + 1; ++slice) {
            const MlUint edge = tile.base_code + (slice << tile.form.slice_shift);
            for (const MlUint pixel : {0u, 9u}) {
                const MlFloat2 place{static_cast<float>(pixel) + 0.5f, 4.5f};
                EXPECT_EQ(walk(buffers, std::nextafter(depth_of(edge), 0.0f), place).lights,
                          candidates(tile, edge - 1, pixel, 4));
                EXPECT_EQ(walk(buffers, depth_of(edge), place).lights, candidates(tile, edge, pixel, 4));
                EXPECT_EQ(walk(buffers, std::nextafter(depth_of(edge), 1e9f), place).lights,
                          candidates(tile, edge, pixel, 4));
            }
        }
    }
}

// A light that ends or begins at a point's own code is handed out there, and one code further it is not.
TEST(Windows, LightsBeginAndEndAtTheirCodes) {
    MadeTile tile;
    tile.base_code = 500;
    tile.form = {4, 0, 0, 7, 0, 0, 0};
    for (MlUint i = 0; i < 100; ++i) tile.small.push_back({i, 500 + i, 520 + i});
    HandmadeBuffers buffers = buffers_of({tile});
    for (MlUint code = 480; code < 700; ++code)
        EXPECT_EQ(walk_at(buffers, code, 0, 0).lights, holders(tile, code, 0, 0));
}

// 65,535 references are the most of a narrow tile; with 70,000 it must be wide.
TEST(Windows, TilesOfVeryManyReferencesKeepAllBitsOfTheirWindows) {
    oracle::Random random(13);
    for (const Kind& kind : {kKinds[0], kKinds[1], kKinds[2], kKinds[3]}) {
        const MlUint count = kind.wide != 0 ? 70000 : 65535;
        const MadeTile tile = made_tile(random, kind, count, 16);
        HandmadeBuffers buffers = buffers_of({tile});
        for (MlUint slice = 0; slice < 16; ++slice) {
            const MlUint code = tile.base_code + (slice << 5) + random.below(32);
            const Walk result = walk_at(buffers, code, 5, 6);
            EXPECT_EQ(result.lights, candidates(tile, code, 5, 6)) << kind.name;
            EXPECT_EQ(result.references, compared(tile, code)) << kind.name;
            EXPECT_TRUE(std::ranges::any_of(result.lights, [=](MlUint light) { return light > 7 * (count - 4000); }));
        }
        EXPECT_EQ(buffers.reads_outside, 0);
    }
}

TEST(Windows, TheFirstAndTheLastCodeAreDepthsLikeOthers) {
    MadeTile tile;
    tile.form = {16, 16, 0, 255, 0, 0, 0};
    tile.small = {{1, 0, 0}, {2, 0, ML_DEPTH_CODE_MAX}, {3, ML_DEPTH_CODE_MAX, ML_DEPTH_CODE_MAX}};
    HandmadeBuffers buffers = buffers_of({tile});
    for (const float depth : {0.0f, -0.0f, -5.0f, -kInfinity, kNan, 0.01f})
        EXPECT_EQ(walk(buffers, depth).lights, (std::vector<MlUint>{1, 2})) << depth;
    for (const float depth : {depth_of(ML_DEPTH_CODE_MAX), 1e10f, 3e38f, kInfinity})
        EXPECT_EQ(walk(buffers, depth).lights, (std::vector<MlUint>{2, 3})) << depth;
    EXPECT_EQ(walk(buffers, depth_of(0x800000u)).lights, std::vector<MlUint>{2});
}

// A difference of codes that wraps must not come out as a slice, whatever the width of one.
TEST(Windows, NothingIsBeforeTheFirstSlice) {
    for (const MlUint slice_shift : {0u, 12u, 24u}) {
        MadeTile tile;
        tile.base_code = 4096;
        tile.form = {slice_shift, 24, 0, 255, 0, 0, 0};
        tile.small = {{1, 4096, ML_DEPTH_CODE_MAX}};
        HandmadeBuffers buffers = buffers_of({tile});
        EXPECT_EQ(walk_at(buffers, 4096, 0, 0).lights, std::vector<MlUint>{1});
        for (const MlUint code : {0u, 1u, 4000u, 4095u}) EXPECT_EQ(walk_at(buffers, code, 0, 0).nodes, 1u) << code;
    }
}

TEST(Windows, AnEmptyTileCostsItsHeader) {
    oracle::Random random(14);
    HandmadeBuffers buffers = buffers_of({MadeTile{}, made_tile(random, kKinds[0], 5, 3)});
    for (const float depth : {0.0f, 1.0f, 100.0f, 200.0f, kInfinity, kNan}) {
        const Walk result = walk(buffers, depth);
        EXPECT_TRUE(result.lights.empty());
        EXPECT_EQ(result.nodes, 1u);
        EXPECT_EQ(result.references, 0u);
    }
    EXPECT_EQ(buffers.reads_outside, 0);
}

TEST(Windows, EachPixelReadsItsOwnTile) {
    oracle::Random random(15);
    std::vector<MadeTile> tiles;
    for (const Kind& kind : kKinds) tiles.push_back(made_tile(random, kind, 60, 6));
    tiles.push_back({});
    HandmadeBuffers buffers;
    append_tiles({made_tile(random, kKinds[1], 9, 3)}, buffers.cells, buffers.references); // a view before
    const MlUint before = static_cast<MlUint>(buffers.cells.size());
    append_tiles(tiles, buffers.cells, buffers.references);
    buffers.frame_view = windows_view(6, static_cast<MlUint>(buffers.cells.size()) - before, kScale);
    buffers.frame_view.cell_offset = before;
    for (MlUint t = 0; t < 6; ++t)
        for (MlUint x = 0; x < 16; ++x) {
            const MlUint code = tiles[t].base_code + random.below(200);
            const std::vector<MlUint> expected = t == 5 ? std::vector<MlUint>{} : candidates(tiles[t], code, x, 15 - x);
            EXPECT_EQ(walk_at(buffers, code, 16 * t + x, 15 - x).lights, expected);
        }
    const MlUint code = tiles[0].base_code + 50;
    EXPECT_EQ(walk(buffers, depth_of(code), {-9.0f, kNan}).lights, candidates(tiles[0], code, 0, 0));
    EXPECT_EQ(buffers.reads_outside, 0);
}

// Tiles of several rows whose edge is no power of two, cut by the image.
TEST(Windows, StepsAreSixteenthsOfTheTile) {
    std::vector<MadeTile> tiles(6);
    for (MlUint t = 0; t < 6; ++t) {
        tiles[t].form = {5, 0, 0, 0, 0, 0, 16 + 16};
        for (MlUint i = 0; i < 16; ++i) tiles[t].small.push_back({100 * t + i, 0, 20, i, i, 0, 15});
        for (MlUint i = 0; i < 16; ++i) tiles[t].small.push_back({100 * t + 16 + i, 0, 20, 0, 15, i, i});
    }
    HandmadeBuffers buffers = buffers_of(tiles);
    buffers.frame_view.width = 70, buffers.frame_view.height = 40;
    buffers.frame_view.tile_px = 24, buffers.frame_view.tiles_x = 3, buffers.frame_view.tiles_y = 2;
    for (MlUint y = 0; y < 40; ++y)
        for (MlUint x = 0; x < 70; ++x) {
            const MlUint tile = 100 * (y / 24 * 3 + x / 24);
            ASSERT_EQ(walk_at(buffers, 3, x, y).lights,
                      (std::vector<MlUint>{tile + x % 24 * 2 / 3, tile + 16 + y % 24 * 2 / 3}));
        }
}

TEST(Windows, CountersCountHeadersEntriesAndWhatIsCompared) {
    oracle::Random random(16);
    for (const Kind& kind : kKinds) {
        const MadeTile tile = made_tile(random, kind, 90, 4);
        HandmadeBuffers buffers = buffers_of({tile});
        const Walk inside = walk_at(buffers, tile.base_code + 70, 8, 8);
        EXPECT_EQ(inside.nodes, kind.is_flat ? 1u : 2u) << kind.name;
        EXPECT_EQ(inside.tested, inside.lights.size());
        EXPECT_GT(inside.references, inside.tested);
        EXPECT_TRUE(!kind.is_flat || inside.references == 90u);
        const Walk before = walk_at(buffers, tile.base_code - 1, 8, 8);
        EXPECT_EQ(before.nodes, 1u);
        EXPECT_EQ(before.references, 0u);
    }
}

TEST(Windows, TwoCursorsLiveSideBySideAndStayAtTheEnd) {
    oracle::Random random(17);
    const MadeTile tile = made_tile(random, kKinds[1], 120, 2);
    HandmadeBuffers buffers = buffers_of({tile});
    const float depth = depth_of(tile.base_code + 33);
    const std::vector<MlUint> expected = candidates(tile, tile.base_code + 33, 8, 8);
    auto a = buffers.ml_begin(buffers.frame_view, {8.5f, 8.5f}, depth);
    auto b = a;
    MlUint light_a, light_b;
    for (const MlUint light : expected) {
        ASSERT_TRUE(buffers.ml_next(a, light_a));
        ASSERT_TRUE(buffers.ml_next(b, light_b));
        EXPECT_EQ(light_a, light);
        EXPECT_EQ(light_b, light);
    }
    for (int i = 0; i < 3; ++i) {
        EXPECT_FALSE(buffers.ml_next(a, light_a));
        EXPECT_EQ(light_a, 0u);
    }
    EXPECT_FALSE(buffers.ml_next(b, light_b));
    EXPECT_GT(expected.size(), 2u);
}

} // namespace
} // namespace manylights::test
