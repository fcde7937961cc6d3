#include "src/build/slices.h"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace manylights::test {
namespace {

using detail::make_slices;
using detail::slice_of;
using detail::Slices;

// The edges that the authors of Tiled Light Trees give for 16 slices from 5 to 500.
TEST(Slices, AreTheOnesOfTheLiterature) {
    constexpr double kEdges[] = {0,    5.0,  6.8,  9.2,   12.6,  17.1,  23.2,  31.5,
                                 42.9, 58.3, 79.2, 108.0, 146.0, 199.0, 271.0, 368.0};
    const Slices slices = make_slices(16, 5.0f, 500.0f);
    for (int i = 0; i < 16; ++i) EXPECT_NEAR(slices.edges[i], kEdges[i], 0.01 * kEdges[i]) << i;
    EXPECT_EQ(slices.edges[0], 0.0f);
    EXPECT_EQ(slices.edges[1], 5.0f);
    EXPECT_TRUE(std::isinf(slices.edges[16]));
}

// floor(log2(depth) * scale + bias) is right in the middle of each slice; that is all a first guess has to be.
TEST(Slices, AreGuessedByScaleAndBias) {
    for (const std::uint32_t count : {2u, 3u, 16u, 64u, 128u}) {
        const Slices slices = make_slices(count, 0.3f, 4000.0f);
        for (std::uint32_t s = 1; s + 1 < count; ++s) {
            const float middle = std::sqrt(slices.edges[s] * slices.edges[s + 1]);
            const float guess = std::floor(std::log2(middle) * slices.scale + slices.bias);
            EXPECT_EQ(guess, static_cast<float>(s)) << count;
        }
    }
}

// Every slice is reached, the slice grows with the depth, and neighbours of an edge fall on its two sides.
TEST(Slices, EdgesDivideTheDepths) {
    for (const std::uint32_t count : {1u, 2u, 16u, 128u}) {
        const Slices slices = make_slices(count, 5.0f, 500.0f);
        EXPECT_EQ(slice_of(slices, 0.0f), 0u);
        EXPECT_EQ(slice_of(slices, -7.0f), 0u);
        EXPECT_EQ(slice_of(slices, std::numeric_limits<float>::infinity()), count - 1);
        for (std::uint32_t s = 1; s < count; ++s) {
            EXPECT_EQ(slice_of(slices, slices.edges[s]), s);
            EXPECT_EQ(slice_of(slices, std::nextafter(slices.edges[s], 0.0f)), s - 1);
        }
    }
}

TEST(Slices, ExtremeBoundsStayUsable) {
    const float tiny = std::numeric_limits<float>::denorm_min();
    const float huge = std::numeric_limits<float>::max();
    const float bounds[][2] = {{tiny, huge}, {1e-30f, 1e-29f}, {5.0f, std::nextafter(5.0f, 6.0f)}, {1e30f, huge}};
    for (const auto& bound : bounds) {
        const Slices slices = make_slices(128, bound[0], bound[1]);
        EXPECT_TRUE(std::isfinite(slices.scale) && std::isfinite(slices.bias));
        for (std::uint32_t s = 1; s <= 128; ++s) EXPECT_GE(slices.edges[s], slices.edges[s - 1]);
        EXPECT_EQ(slices.edges[1], bound[0]);
    }
}

} // namespace
} // namespace manylights::test
