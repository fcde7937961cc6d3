// ml_slice and ml_cell_index against plain searches.

#include "tests/shader/shader_text.h"

#include "reference/oracle/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace manylights::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// count slices: [0, near), then equal ratios up to far, the last one open.
HandmadeBuffers with_slices(MlUint count, double near_edge, double far_edge) {
    HandmadeBuffers buffers;
    buffers.frame_view = one_cell_view(ML_STRUCTURE_LISTS);
    buffers.frame_view.slice_count = count;
    buffers.frame_view.slice_offset = 3;
    double scale = count > 1 ? (count - 1) / std::log2(far_edge / near_edge) : 0.0;
    buffers.frame_view.slice_scale = static_cast<float>(scale);
    buffers.frame_view.slice_bias = static_cast<float>(1.0 - std::log2(near_edge) * scale);
    buffers.slice_edges = {-7.0f, -7.0f, -7.0f, 0.0f};
    for (MlUint i = 1; i < count; ++i)
        buffers.slice_edges.push_back(
            static_cast<float>(near_edge * std::pow(far_edge / near_edge, (i - 1.0) / (count - 1.0))));
    buffers.slice_edges.push_back(kInfinity);
    return buffers;
}

MlUint slice_by_linear_search(const HandmadeBuffers& buffers, float depth) {
    MlUint slice = 0;
    for (MlUint i = 1; i < buffers.frame_view.slice_count; ++i)
        if (depth >= buffers.slice_edges[buffers.frame_view.slice_offset + i]) slice = i;
    return slice;
}

float steps_from(float value, int steps) {
    for (; steps > 0; --steps) value = std::nextafter(value, kInfinity);
    for (; steps < 0; ++steps) value = std::nextafter(value, -kInfinity);
    return value;
}

void expect_same_slices(HandmadeBuffers buffers, const char* what) {
    int checked = 0;
    for (MlUint i = 1; i < buffers.frame_view.slice_count; ++i)
        for (int steps = -8; steps <= 8; ++steps, ++checked) {
            float depth = steps_from(buffers.slice_edges[buffers.frame_view.slice_offset + i], steps);
            ASSERT_EQ(buffers.ml_slice(buffers.frame_view, depth), slice_by_linear_search(buffers, depth))
                << what << ", edge " << i << ", " << steps << " steps";
        }
    for (float depth : {0.0f, -0.0f, -1.0f, 1e-45f, 1e-20f, 0.1f, 1.0f, 1e20f, 3e38f, kInfinity, -kInfinity, kNan})
        ASSERT_EQ(buffers.ml_slice(buffers.frame_view, depth), slice_by_linear_search(buffers, depth))
            << what << ' ' << depth;
    EXPECT_EQ(checked, 17 * (static_cast<int>(buffers.frame_view.slice_count) - 1));
    EXPECT_EQ(buffers.reads_outside, 0);
}

TEST(MlSlice, EqualsALinearSearchAroundEveryEdge) {
    for (MlUint count : {1u, 2u, 3u, 16u, 128u})
        for (double far_edge : {5.0001, 6.0, 500.0, 1e6})
            expect_same_slices(with_slices(count, 5.0, far_edge), "right guess");
}

TEST(MlSlice, DoesNotDependOnThePrecisionOfTheLogarithm) {
    for (float scale : {0.0f, 0.5f, 0.9999f, 1.0001f, 3.0f, -1.0f})
        for (float bias : {-100.0f, -0.001f, 0.001f, 1.0f, 100.0f}) {
            HandmadeBuffers buffers = with_slices(16, 5.0, 500.0);
            buffers.frame_view.slice_scale *= scale;
            buffers.frame_view.slice_bias += bias;
            expect_same_slices(buffers, "wrong guess");
        }
}

TEST(MlSlice, ALogarithmAloneIsWrongBesideTheEdges) {
    HandmadeBuffers buffers = with_slices(128, 5.0, 500.0);
    int wrong = 0;
    for (MlUint i = 1; i < 128; ++i)
        for (int steps = -4; steps <= 4; ++steps) {
            float depth = steps_from(buffers.slice_edges[buffers.frame_view.slice_offset + i], steps);
            float guess = std::log2(depth) * buffers.frame_view.slice_scale + buffers.frame_view.slice_bias;
            MlUint naive = guess < 0.0f ? 0u : (guess >= 127.0f ? 127u : static_cast<MlUint>(guess));
            wrong += naive != slice_by_linear_search(buffers, depth) ? 1 : 0;
        }
    EXPECT_GT(wrong, 100) << "these depths must be able to tell a guess from the table";
}

TEST(MlCellIndex, EqualsIntegerDivisionForEveryPixelOfAwkwardSizes) {
    oracle::Random random(1);
    for (MlUint tile_px : {1u, 8u, 13u, 48u, 65536u})
        for (MlUint width : {1u, 47u, 48u, 49u, 97u}) {
            HandmadeBuffers buffers = with_slices(4, 1.0, 10.0);
            buffers.frame_view.width = width;
            buffers.frame_view.height = 33;
            buffers.frame_view.tile_px = tile_px;
            buffers.frame_view.tiles_x = (width + tile_px - 1) / tile_px;
            buffers.frame_view.tiles_y = (33 + tile_px - 1) / tile_px;
            buffers.frame_view.cell_offset = 1000;
            for (MlUint y = 0; y < 33; ++y)
                for (MlUint x = 0; x < width; ++x) {
                    float depth = static_cast<float>(random.between(0.0, 20.0));
                    MlUint slice = slice_by_linear_search(buffers, depth);
                    MlUint expected = 1000 +
                                      (slice * buffers.frame_view.tiles_y + y / tile_px) * buffers.frame_view.tiles_x +
                                      x / tile_px;
                    MlFloat2 position{static_cast<float>(x) + static_cast<float>(random.below(4)) * 0.25f,
                                      static_cast<float>(y) + 0.5f};
                    ASSERT_EQ(buffers.ml_cell_index(buffers.frame_view, position, depth), expected) << x << ' ' << y;
                }
        }
}

TEST(MlCellIndex, PositionsOutsideTheImageAreClamped) {
    HandmadeBuffers buffers = with_slices(1, 1.0, 10.0);
    buffers.frame_view.width = 100;
    buffers.frame_view.height = 50;
    buffers.frame_view.tile_px = 8;
    buffers.frame_view.tiles_x = 13;
    buffers.frame_view.tiles_y = 7;
    for (float low : {-kInfinity, -1e30f, -1.0f, -0.0f, 0.0f, kNan})
        EXPECT_EQ(buffers.ml_cell_index(buffers.frame_view, {low, low}, 1.0f), 0u) << low;
    for (float high : {100.0f, 101.0f, 5e9f, 1e30f, kInfinity})
        EXPECT_EQ(buffers.ml_cell_index(buffers.frame_view, {high, high}, 1.0f), 13u * 7u - 1u) << high;
}

} // namespace
} // namespace manylights::test
