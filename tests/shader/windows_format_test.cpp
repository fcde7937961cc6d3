// The integers of depth windows: depth codes, forms of tiles, bounds of references.

#include "reference/oracle/random.h"
#include "tests/shader/handmade_windows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace manylights::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(MlDepthCode, IsTheTruncatedProduct) {
    for (float scale : {0x1p-20f, 0.25f, 1.0f, 64.0f, 0x1p90f})
        for (MlUint code : {1u, 2u, 3u, 1000u, 65535u, 65536u, 8388607u, 8388608u, 16777214u, 16777215u}) {
            const float depth = static_cast<float>(code) / scale;
            EXPECT_EQ(ml_depth_code(depth, scale), code) << scale;
            EXPECT_EQ(ml_depth_code(std::nextafter(depth, 0.0f), scale), code - 1) << scale;
            const MlUint above = code >= 8388608u ? std::min(code + 1, ML_DEPTH_CODE_MAX) : code;
            EXPECT_EQ(ml_depth_code(std::nextafter(depth, kInfinity), scale), above) << scale;
        }
}

TEST(MlDepthCode, SaturatesOnBothSides) {
    for (float scale : {0x1p-126f, 1.0f, 0x1p126f}) {
        for (float depth : {0.0f, -0.0f, -1.0f, -kInfinity, kNan, std::numeric_limits<float>::denorm_min()})
            EXPECT_EQ(ml_depth_code(depth, scale), 0u) << depth;
        EXPECT_EQ(ml_depth_code(kInfinity, scale), ML_DEPTH_CODE_MAX);
    }
    EXPECT_EQ(ml_depth_code(0x1p24f, 1.0f), ML_DEPTH_CODE_MAX);
    EXPECT_EQ(ml_depth_code(3e38f, 0x1p126f), ML_DEPTH_CODE_MAX);
    EXPECT_EQ(ml_depth_code(0x1.FFFFFCp-127f, 0x1p126f), 0u) << "what a processor may flush has code 0 unflushed too";
    EXPECT_EQ(ml_depth_code(-3e38f, 0x1p126f), 0u);
}

TEST(MlDepthCode, NeverDescends) {
    oracle::Random random(5);
    for (int i = 0; i < 100000; ++i) {
        const float depth = static_cast<float>(random.octaves(-10, 30)),
                    scale = std::ldexp(1.0f, static_cast<int>(random.below(12)) - 6);
        EXPECT_LE(ml_depth_code(std::nextafter(depth, 0.0f), scale), ml_depth_code(depth, scale)) << depth;
    }
}

TEST(MlTileForm, IsUnpackedAsItWasPacked) {
    const MlTileForm forms[] = {{31, 0, 0, 0, 0, 0, 0},  {0, 31, 0, 0, 0, 0, 0}, {0, 0, 31, 0, 0, 0, 0},
                                {0, 0, 0, 255, 0, 0, 0}, {0, 0, 0, 0, 1, 0, 0},  {0, 0, 0, 0, 0, 1, 0},
                                {0, 0, 0, 0, 0, 0, 127}, {5, 6, 7, 200, 1, 0, 9}};
    MlUint all = 0;
    for (const MlTileForm& form : forms) {
        const MlTileForm got = ml_tile_form(ml_pack_tile_form(form));
        EXPECT_EQ(got.slice_shift, form.slice_shift);
        EXPECT_EQ(got.small_shift, form.small_shift);
        EXPECT_EQ(got.large_shift, form.large_shift);
        EXPECT_EQ(got.last_slice, form.last_slice);
        EXPECT_EQ(got.two_classes, form.two_classes);
        EXPECT_EQ(got.wide, form.wide);
        EXPECT_EQ(got.flat_count, form.flat_count);
        all |= ml_pack_tile_form(form);
    }
    EXPECT_EQ(all, 0xFFFFFFFFu) << "the fields have all bits";
}

TEST(MlTileForm, SaysHowManyCellsTheEntriesTake) {
    for (MlUint last : {0u, 1u, 2u, 254u, 255u}) {
        EXPECT_EQ(ml_entry_cell_count({1, 0, 0, last, 0, 0, 0}), (last + 2) / 2);
        EXPECT_EQ(ml_entry_cell_count({1, 0, 0, last, 1, 0, 0}), last + 1);
        EXPECT_EQ(ml_entry_cell_count({1, 0, 0, last, 0, 1, 0}), last + 1);
        EXPECT_EQ(ml_entry_cell_count({1, 0, 0, last, 1, 1, 0}), 2 * (last + 1));
    }
    EXPECT_EQ(ml_entry_cell_count({1, 0, 0, 0, 0, 0, 8}), 0u);
}

TEST(MlTileStep, DividesTheTileIntoSixteenInOrder) {
    for (MlUint tile_px : {1u, 8u, 13u, 16u, 24u, 32u, 48u, 100u, 65536u}) {
        MlUint before = 0;
        for (MlUint pixel = 0; pixel < tile_px; ++pixel) {
            const MlUint step = ml_tile_step(pixel, tile_px);
            ASSERT_LE(before, step);
            ASSERT_LT(step, 16u);
            ASSERT_TRUE(step * tile_px <= pixel * 16u && pixel * 16u < (step + 1) * tile_px) << tile_px;
            before = step;
        }
        EXPECT_EQ(ml_tile_step(0, tile_px), 0u);
    }
}

// Every low end modulo 256, near, far and across the top of the codes, with every extent and every depth inside.
TEST(MlBoundsHold, DepthsModulo256LoseNothing) {
    for (MlUint start : {0u, 256u * 77u, ML_DEPTH_CODE_MAX - 767u})
        for (MlUint low = start; low < start + 256; ++low)
            for (MlUint extent = 0; extent < 256; ++extent) {
                const MlUint bounds = ml_pack_bounds(low, low + extent, 0, 15, 0, 15);
                for (MlUint depth = low; depth <= low + extent; ++depth)
                    if (!ml_bounds_hold(bounds, depth, 7, 7)) FAIL() << low << " + " << extent << " at " << depth;
            }
}

TEST(MlBoundsHold, DeniesEveryDepthOutsideUpTo256Units) {
    for (MlUint low : {1000u, 1023u, 1024u})
        for (MlUint extent = 0; extent < 256; ++extent) {
            const MlUint bounds = ml_pack_bounds(low, low + extent, 0, 15, 0, 15);
            for (MlUint depth = low + extent + 1; depth < low + 256; ++depth)
                ASSERT_FALSE(ml_bounds_hold(bounds, depth, 7, 7)) << low << " + " << extent << " at " << depth;
            for (MlUint depth = low + extent - 255; depth < low; ++depth)
                ASSERT_FALSE(ml_bounds_hold(bounds, depth, 7, 7)) << low << " + " << extent << " at " << depth;
            ASSERT_TRUE(ml_bounds_hold(bounds, low + 256, 7, 7)) << "depths come again after 256 units";
        }
}

TEST(MlBoundsHold, EveryRectangleHoldsItsStepsAndNoOthers) {
    for (MlUint first = 0; first < 16; ++first)
        for (MlUint last = first; last < 16; ++last)
            for (MlUint step = 0; step < 16; ++step) {
                const bool inside = first <= step && step <= last;
                ASSERT_EQ(ml_bounds_hold(ml_pack_bounds(3, 9, first, last, 2, 4), 5, step, 3), inside);
                ASSERT_EQ(ml_bounds_hold(ml_pack_bounds(3, 9, 2, 4, first, last), 5, 3, step), inside);
                ASSERT_FALSE(ml_bounds_hold(ml_pack_bounds(3, 9, first, last, 2, 4), 5, step, 5));
            }
}

} // namespace
} // namespace manylights::test
