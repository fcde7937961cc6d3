// Pixels and depths of a sphere: never less than what its points show, and not much more.

#include "src/build/bounds.h"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace manylights::test {
namespace {

using detail::Interval;

// The slopes of many points of the disc with depth >= near_depth.
Interval sample_slopes(double offset, double depth, double radius, double near_depth) {
    Interval found = {1e300, -1e300};
    const auto add = [&](double x, double z) {
        if (z < near_depth) return;
        found.low = std::min(found.low, x / z);
        found.high = std::max(found.high, x / z);
    };
    for (int i = 0; i < 2000; ++i) {
        const double angle = i * 3.14159265358979 / 1000.0;
        add(offset + radius * std::cos(angle), depth + radius * std::sin(angle));
    }
    const double height = near_depth - depth;
    if (std::fabs(height) < radius) { // the circle's cut with the near plane
        const double half = std::sqrt(radius * radius - height * height);
        add(offset - half, near_depth);
        add(offset + half, near_depth);
    }
    return found;
}

TEST(SlopeBounds, HoldEveryPointOfTheDiscAndLittleMore) {
    Random random(11);
    int near_cuts = 0;
    int camera_inside = 0;
    for (int i = 0; i < 3000; ++i) {
        const double offset = random.between(-5, 5);
        const double depth = random.between(-2, 6);
        const double radius = random.between(0.01, 5);
        const double near_depth = 0.1;
        if (depth + radius < near_depth) continue;
        const Interval bounds = detail::slope_bounds(offset, depth, radius, near_depth);
        const Interval samples = sample_slopes(offset, depth, radius, near_depth);
        if (samples.empty()) continue;
        near_cuts += depth - radius < near_depth ? 1 : 0;
        camera_inside += offset * offset + depth * depth < radius * radius ? 1 : 0;
        const double slack = 1e-9 * (1.0 + std::fabs(samples.high) + std::fabs(samples.low));
        EXPECT_LE(bounds.low, samples.low + slack) << offset << " " << depth << " " << radius;
        EXPECT_GE(bounds.high, samples.high - slack) << offset << " " << depth << " " << radius;
        // Sampling misses the true extreme by a little, more where the circle touches the near plane.
        const double loose = 0.02 * (samples.high - samples.low) + 1e-3;
        EXPECT_NEAR(bounds.low, samples.low, loose) << offset << " " << depth << " " << radius;
        EXPECT_NEAR(bounds.high, samples.high, loose) << offset << " " << depth << " " << radius;
    }
    EXPECT_GT(near_cuts, 500);
    EXPECT_GT(camera_inside, 100);
}

TEST(SlopeBounds, AreUnboundedWhereTheNearPlaneIsUnknown) {
    const Interval inside = detail::slope_bounds(0.5, 0.5, 2.0, 0.0);
    EXPECT_EQ(inside.low, -detail::kUnbounded);
    EXPECT_EQ(inside.high, detail::kUnbounded);
    EXPECT_EQ(detail::slope_bounds(-2.0, 0.0, 2.0, 0.0).high, detail::kUnbounded) << "touches the camera itself";
    const Interval in_front = detail::slope_bounds(0.5, 5.0, 1.0, 0.0);
    EXPECT_GT(in_front.low, -1.0);
    EXPECT_LT(in_front.high, 1.0);
}

TEST(SlopeBounds, HoldForHugeSpheres) {
    for (const double radius : {1e6, 1e18}) {
        const Interval bounds = detail::slope_bounds(3.0, 10.0, radius, 0.1);
        EXPECT_LT(bounds.low, -1e5);
        EXPECT_GT(bounds.high, 1e5);
        EXPECT_TRUE(std::isfinite(bounds.low) && std::isfinite(bounds.high));
    }
}

const detail::Axis kAxis = {50.0, 50.0, 100}; // slope -1 to 1 over 100 pixels

TEST(PixelBounds, ReachAPixelWhoseGuardTouches) {
    // Slopes from pixel position 20.0 to 30.0. Pixel 19's centre is 19.5: the guard of 0.5 touches.
    const Interval slopes = {-0.6, -0.4};
    const detail::PixelRange pixels = detail::pixel_bounds(kAxis, slopes, 0.5);
    EXPECT_FALSE(pixels.empty);
    EXPECT_EQ(pixels.first, 19u);
    EXPECT_EQ(pixels.last, 30u);
    const detail::PixelRange wide = detail::pixel_bounds(kAxis, slopes, 3.0);
    EXPECT_EQ(wide.first, 17u);
    EXPECT_EQ(wide.last, 32u);
    const detail::PixelRange narrow = detail::pixel_bounds(kAxis, slopes, 0.0);
    EXPECT_EQ(narrow.first, 20u);
    EXPECT_EQ(narrow.last, 29u);
}

TEST(PixelBounds, AreClampedToTheImageOrEmpty) {
    const detail::PixelRange all = detail::pixel_bounds(kAxis, {-detail::kUnbounded, detail::kUnbounded}, 0.5);
    EXPECT_EQ(all.first, 0u);
    EXPECT_EQ(all.last, 99u);
    EXPECT_TRUE(detail::pixel_bounds(kAxis, {1.1, detail::kUnbounded}, 0.5).empty);
    EXPECT_TRUE(detail::pixel_bounds(kAxis, {-detail::kUnbounded, -1.1}, 0.5).empty);
    EXPECT_TRUE(detail::pixel_bounds(kAxis, {1e30, 2e30}, 0.5).empty);
    // Just outside, but within the guard of the first pixel.
    EXPECT_FALSE(detail::pixel_bounds(kAxis, {-1.1, -1.005}, 3.0).empty);
}

TEST(PixelBounds, FollowAMirroredAxis) {
    const detail::Axis mirrored = {-50.0, 50.0, 100};
    const detail::PixelRange pixels = detail::pixel_bounds(mirrored, {-0.6, -0.4}, 0.5);
    EXPECT_EQ(pixels.first, 69u);
    EXPECT_EQ(pixels.last, 80u);
}

TEST(DepthBounds, AreWidenedAndRoundedOutward) {
    Random random(3);
    for (int i = 0; i < 10000; ++i) {
        const double depth = random.between(-100, 1000) * std::pow(10.0, random.between(-8, 8));
        const double radius = random.between(0, 100) * std::pow(10.0, random.between(-8, 8));
        const detail::DepthRange range = detail::depth_bounds(depth, radius);
        const double low = depth - radius;
        const double high = depth + radius;
        EXPECT_LE(range.low, low - std::fabs(low) * 0x1p-20);
        EXPECT_GE(range.high, high + std::fabs(high) * 0x1p-20);
        EXPECT_NEAR(range.low, low, std::fabs(low) * 1.2e-6);
        EXPECT_NEAR(range.high, high, std::fabs(high) * 1.2e-6);
    }
    const detail::DepthRange beyond = detail::depth_bounds(3e38, 3e38);
    EXPECT_TRUE(std::isinf(beyond.high));
    EXPECT_LE(beyond.low, 0.0f);
}

} // namespace
} // namespace manylights::test
