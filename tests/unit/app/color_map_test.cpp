#include "lab/app/color_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace manylights::lab::app {
namespace {

TEST(ColorMap, lightness_grows_evenly_with_the_value) {
    constexpr int kSteps = 64;
    const float bottom = lightness(heat_color(0.0f)), top = lightness(heat_color(1.0f));
    ASSERT_GT(top - bottom, 0.7f);
    float before = bottom;
    for (int i = 1; i <= kSteps; ++i) {
        const float value = static_cast<float>(i) / kSteps;
        const float here = lightness(heat_color(value));
        EXPECT_GT(here, before) << "at " << value;
        EXPECT_NEAR(here, bottom + (top - bottom) * value, 0.02f) << "at " << value;
        before = here;
    }
}

TEST(ColorMap, values_outside_are_clamped_and_nan_is_the_lowest) {
    EXPECT_EQ(heat_color(-3.0f), heat_color(0.0f));
    EXPECT_EQ(heat_color(17.0f), heat_color(1.0f));
    EXPECT_EQ(heat_color(INFINITY), heat_color(1.0f));
    EXPECT_EQ(heat_color(NAN), heat_color(0.0f));
}

TEST(ColorMap, lightness_spans_black_to_white) {
    EXPECT_NEAR(lightness({0, 0, 0}), 0.0f, 1e-3f);
    EXPECT_NEAR(lightness({255, 255, 255}), 1.0f, 1e-3f);
}

} // namespace
} // namespace manylights::lab::app
