// ml_affects against exact arithmetic, and the light hashes.

#include "reference/oracle/cases.h"
#include "reference/oracle/light_hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace manylights::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(MlAffects, AgreesWithExactDistancesExceptWithinRoundingOfTheSurface) {
    oracle::Random random(3);
    int inside = 0, outside = 0, beside = 0;
    for (int i = 0; i < 200000; ++i) {
        oracle::Double3 center = random.direction() * random.octaves(-3, 10);
        float range = static_cast<float>(random.octaves(-6, 6));
        double ratio = random.chance(0.5) ? 1.0 + random.between(-4e-7, 4e-7) : random.between(0.0, 2.0);
        MlFloat3 c = oracle::to_float(center);
        MlFloat3 p = oracle::to_float(center + random.direction() * (range * ratio));
        double distance = length(oracle::to_double(p) - oracle::to_double(c));
        // Each difference is off by 2^-24 of itself, squares and sums by less than 4 * 2^-24, so distances compare
        // rightly outside of 2^-21 relative.
        if (std::fabs(distance - range) < range * std::ldexp(1.0, -21)) {
            ++beside;
            continue;
        }
        ASSERT_EQ(ml_affects(p, c, range), distance < range) << i;
        (distance < range ? inside : outside) += 1;
    }
    EXPECT_GT(inside, 40000);
    EXPECT_GT(outside, 40000);
    EXPECT_GT(beside, 1000);
}

TEST(MlAffects, ThePointOnTheSurfaceIsOutside) {
    EXPECT_FALSE(ml_affects({3.0f, 4.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 5.0f));
    EXPECT_TRUE(ml_affects({3.0f, 4.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, std::nextafter(5.0f, 6.0f)));
    EXPECT_FALSE(ml_affects({101.0f, -4.0f, 9.0f}, {99.0f, -3.0f, 7.0f}, 3.0f));
    EXPECT_TRUE(ml_affects({101.0f, -4.0f, 9.0f}, {99.0f, -3.0f, 7.0f}, std::nextafter(3.0f, 4.0f)));
}

TEST(MlAffects, RangeZeroAndNanAffectNothing) {
    EXPECT_FALSE(ml_affects({1.0f, 2.0f, 3.0f}, {1.0f, 2.0f, 3.0f}, 0.0f));
    EXPECT_FALSE(ml_affects({1.0f, 2.0f, 3.0f}, {1.0f, 2.0f, 3.0f}, kNan));
    EXPECT_FALSE(ml_affects({kNan, 2.0f, 3.0f}, {1.0f, 2.0f, 3.0f}, 10.0f));
    EXPECT_FALSE(ml_affects({1.0f, 2.0f, 3.0f}, {kInfinity, 2.0f, 3.0f}, 10.0f));
    EXPECT_TRUE(ml_affects({1.0f, 2.0f, 3.0f}, {1.0f, 2.0f, 3.0f}, 1e-10f));
    EXPECT_TRUE(ml_affects({1.0f, 2.0f, 3.0f}, {-1e17f, 1e17f, 0.0f}, 1e18f));
}

TEST(Oracle, TheLeastRangeIsTheLeast) {
    oracle::Random random(4);
    for (int i = 0; i < 10000; ++i) {
        MlFloat3 p = oracle::to_float(random.direction() * random.octaves(-3, 10));
        MlFloat3 c = oracle::to_float(random.direction() * random.octaves(-3, 10));
        float range = oracle::least_range(p, c);
        ASSERT_TRUE(ml_affects(p, c, range));
        ASSERT_FALSE(ml_affects(p, c, std::nextafter(range, 0.0f)));
    }
}

TEST(Oracle, TheFloatPredicateAcceptsPointsOutsideTheSphere) {
    // Why structures must cull with a slightly larger radius: the predicate rounds.
    oracle::Random random(5);
    int accepted_outside = 0;
    for (int i = 0; i < 10000; ++i) {
        MlFloat3 p = oracle::to_float(random.direction() * 10.0);
        MlFloat3 c = oracle::to_float(random.direction() * 10.0);
        oracle::RelativeLight light{c, oracle::least_range(p, c), 0};
        accepted_outside += distance_to_surface(p, light) > 0.0 ? 1 : 0;
    }
    EXPECT_GT(accepted_outside, 100);
}

TEST(Oracle, ProjectionAndUnprojectionAreInverse) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        oracle::Random random(seed);
        oracle::Camera camera = random_camera(random);
        oracle::ScreenPosition screen{random.between(0.0, camera.view.width), random.between(0.0, camera.view.height),
                                      random.octaves(-3, 10)};
        oracle::ScreenPosition again = project_view_space(
            camera, view_from_relative(camera, relative_from_view(camera, unproject_view_space(camera, screen))));
        ASSERT_NEAR(again.x, screen.x, 1e-7 * camera.view.width);
        ASSERT_NEAR(again.y, screen.y, 1e-7 * camera.view.height);
        ASSERT_NEAR(again.depth, screen.depth, 1e-7 * screen.depth);
        ASSERT_GT(camera.near_depth, 0.0);
        ASSERT_GT(camera.far_depth, camera.near_depth * 10.0);
    }
}

TEST(Oracle, CamerasComeInEveryConvention) {
    std::set<int> seen;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        oracle::Random random(seed);
        oracle::Camera camera = random_camera(random);
        const float* r = camera.view.view_from_world;
        const float* c = camera.view.clip_from_view;
        float determinant = r[0] * (r[5] * r[10] - r[6] * r[9]) - r[4] * (r[1] * r[10] - r[2] * r[9]) +
                            r[8] * (r[1] * r[6] - r[2] * r[5]);
        ASSERT_NEAR(std::fabs(determinant), 1.0f, 1e-5f);
        seen.insert(determinant < 0 ? 1 : 2);
        seen.insert(c[11] < 0 ? 3 : 4);
        seen.insert(c[14] > 0 ? 5 : 6);
        seen.insert(std::isinf(camera.far_depth) ? 7 : 8);
        seen.insert(camera.view.clip_y_up != 0 ? 9 : 10);
        seen.insert(std::fabs(camera.eye[0]) > 3e4f ? 11 : 12);
        seen.insert(c[8] != 0.0f ? 13 : 14);
        seen.insert(c[0] < 0.0f ? 15 : 16);
    }
    EXPECT_EQ(seen.size(), 16u);
}

TEST(LightHash, IsOneToOneOverAQuarterMillionLights) {
    std::set<std::uint32_t> a, b;
    for (std::uint32_t i = 0; i < 1u << 18u; ++i) {
        a.insert(light_hash_a(i));
        b.insert(light_hash_b(i));
    }
    EXPECT_EQ(a.size(), 1u << 18u);
    EXPECT_EQ(b.size(), 1u << 18u);
}

TEST(LightSet, TheSumsTellALostLightFromADoubledOne) {
    oracle::LightSet whole, lost, doubled;
    for (std::uint32_t i : {3u, 5u, 8u}) whole.add(i);
    for (std::uint32_t i : {3u, 8u}) lost.add(i);
    for (std::uint32_t i : {3u, 3u, 8u}) doubled.add(i);
    EXPECT_NE(whole.hash_a, lost.hash_a);
    EXPECT_NE(whole.hash_a, doubled.hash_a);
    EXPECT_NE(whole.hash_b, doubled.hash_b);
}

} // namespace
} // namespace manylights::test
