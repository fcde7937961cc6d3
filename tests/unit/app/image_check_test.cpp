#include "lab/app/image_check.h"

#include <gtest/gtest.h>

#include <cmath>

namespace manylights::lab::app {
namespace {

constexpr std::uint32_t kWidth = 4, kHeight = 2;

struct ImageCheck : testing::Test {
    std::vector<float> truth = std::vector<float>(3 * kWidth * kHeight, 0.25f);
    std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(kWidth * kHeight, 1);
    std::string check(const std::vector<float>& got) { return image_difference(truth, got, mask, kWidth, kHeight); }
};

TEST_F(ImageCheck, equal_images_pass) { EXPECT_EQ(check(truth), ""); }

TEST_F(ImageCheck, rounding_passes_and_a_visible_difference_is_named) {
    std::vector<float> got = truth;
    got[3 * 5 + 1] *= 1.0001f;
    EXPECT_EQ(check(got), "");
    got[3 * 5 + 1] *= 1.5f;
    EXPECT_NE(check(got).find("pixel (1, 1) has "), std::string::npos) << check(got);
}

TEST_F(ImageCheck, values_that_are_not_finite_are_named) {
    for (const float bad : {NAN, INFINITY, -INFINITY}) {
        std::vector<float> got = truth;
        got[3 * 6] = bad;
        EXPECT_EQ(check(got), "pixel (2, 1) is not finite");
    }
}

TEST(RadianceOf, is_the_fixed_point_value) {
    PixelRecord record{};
    record.radiance[0] = 1 << 20;
    record.radiance[1] = 1 << 18;
    EXPECT_EQ(radiance_of({record}), (std::vector<float>{1.0f, 0.25f, 0.0f}));
}

} // namespace
} // namespace manylights::lab::app
