#include "lab/scene/error.h"
#include "lab/scene/light_scale.h"
#include "lab/scene/random.h"
#include "lab/scene/scene.h"

#include <gtest/gtest.h>

namespace manylights::lab {
namespace {

LightSet lights(const Scene& scene, const char* radius, std::uint32_t count) {
    return make_lights(scene, scene.cameras.front(), {count, "volume", 1, radius});
}

TEST(RadiusOption, IntervalIsUniformAndUnscaled) {
    const Scene scene = load_scene("cornell");
    const LightSet set = lights(scene, "0.5:2.5", 20'000);
    double sum = 0.0;
    for (const Light& light : set.lights) {
        ASSERT_TRUE(light.sphere.range >= 0.5f && light.sphere.range <= 2.5f);
        sum += double(light.sphere.range);
    }
    EXPECT_NEAR(sum / 20'000.0, 1.5, 0.02);
    EXPECT_EQ(set.radius_scale, 1.0f);
}

TEST(RadiusOption, MixHasTwoLargeLightsInAThousand) {
    const LightSet set = lights(load_scene("canyon", Detail::low), "mix", 100'000);
    int large = 0;
    for (const Light& light : set.lights) {
        const float r = light.sphere.range;
        ASSERT_TRUE((r >= 1.0f && r <= 6.0f) || (r >= 20.0f && r <= 40.0f)) << r;
        large += r >= 20.0f ? 1 : 0;
    }
    EXPECT_NEAR(large, 200, 60);
}

TEST(RadiusOption, BadTextIsRefused) {
    const Scene scene = load_scene("cornell");
    for (const char* text : {"", "automatic", "1", ":", "1:", ":2", "2:1", "-1:2", "1:nan", "1:inf", "1:2:3", "1:1e19"})
        EXPECT_THROW(lights(scene, text, 10), InputError) << text;
    EXPECT_NO_THROW(lights(scene, "0:0", 10));
    EXPECT_NO_THROW(lights(scene, "0:1e18", 10));
}

/// Mean number of lights that contain a visible point, by testing all pairs.
double affecting_mean(const Scene& scene, const LightSet& set) {
    std::size_t points = 0, affecting = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (const SurfacePoint& point : visible_points(scene, scene.cameras[i], 48, 27)) {
            ++points;
            for (const Light& light : set.lights) {
                const float *c = light.sphere.center, r = light.sphere.range;
                const glm::vec3 d = point.position - glm::vec3(c[0], c[1], c[2]);
                affecting += glm::dot(d, d) < r * r ? 1u : 0u;
            }
        }
    }
    return double(affecting) / double(points);
}

TEST(RadiusAuto, LetsSixLightsAffectAVisiblePoint) {
    const Scene scene = load_scene("cornell");
    const LightSet set = lights(scene, "auto", 8192);
    EXPECT_LT(set.radius_scale, 1.0f);
    EXPECT_NEAR(affecting_mean(scene, set), 6.0, 0.3);
}

TEST(RadiusAuto, NeverExceedsTheCapOfTheScene) {
    EXPECT_EQ(lights(load_scene("bars", Detail::low), "auto", 1024).radius_scale, 1.0f);
    EXPECT_EQ(lights(load_scene("citadel", Detail::low), "auto", 1024).radius_scale, 2.0f);
    EXPECT_EQ(lights(load_scene("cornell"), "auto", 0).radius_scale, 1.0f);
}

TEST(RadiusAuto, MatchesTheReferenceWorkloads) {
    const LightSet canyon = lights(load_scene("canyon"), "auto", 65536);
    EXPECT_NEAR(canyon.radius_scale, 0.94f, 0.05f);
    EXPECT_EQ(lights(load_scene("bars"), "auto", 65536).radius_scale, 1.0f);
}

TEST(RadiusScale, IsTheSmallestThatReachesTheWantedNumberOfPairs) {
    std::vector<glm::vec3> points;
    std::vector<Light> some(300);
    for (std::uint32_t i = 0; i < 200; ++i)
        points.emplace_back(random_unit(1, i, 0), 3.0f * random_unit(1, i, 1), 0.2f * random_unit(1, i, 2));
    for (std::uint32_t i = 0; i < some.size(); ++i)
        some[i].sphere = {{random_unit(2, i, 0), 3.0f * random_unit(2, i, 1), random_unit(2, i, 2)},
                          random_between(2, i, 3, 0.1f, 0.9f)};
    const auto pairs = [&](double scale) {
        std::size_t count = 0;
        for (const glm::vec3& p : points) {
            for (const Light& light : some) {
                const glm::dvec3 d =
                    glm::dvec3(p) - glm::dvec3(light.sphere.center[0], light.sphere.center[1], light.sphere.center[2]);
                const double r = scale * double(light.sphere.range);
                count += glm::dot(d, d) < r * r ? 1u : 0u;
            }
        }
        return count;
    };
    for (const double wanted : {0.5, 2.0, 6.0}) {
        const double scale = double(find_radius_scale(points, some, wanted, 10.0f));
        EXPECT_LE(pairs(scale * (1.0 - 1e-6)), std::size_t(wanted * 200.0) + 1);
        EXPECT_GE(pairs(scale * (1.0 + 1e-6)), std::size_t(wanted * 200.0));
    }
    EXPECT_EQ(find_radius_scale(points, some, 6.0, 0.01f), 0.01f);
    EXPECT_EQ(find_radius_scale({}, some, 6.0, 2.0f), 2.0f);
    EXPECT_EQ(find_radius_scale(points, {}, 6.0, 2.0f), 2.0f);
}

// A thousand groups of a thousand: published radii, and about as many lights at a point as elsewhere.
TEST(RadiusAuto, LeavesTheRadiiOfBlocktownsMillion) {
    const Scene scene = load_scene("blocktown");
    const LightSet set = make_lights(scene, scene.cameras.front(), {1'000'000, "groups", 1, "auto"});
    EXPECT_EQ(set.lights.size(), 1'000'000u);
    EXPECT_EQ(set.radius_scale, 1.0f);
    for (const Light& light : set.lights) ASSERT_TRUE(light.sphere.range >= 2.0f && light.sphere.range <= 6.0f);
    std::size_t affecting = 0;
    const std::vector<SurfacePoint> points = visible_points(scene, scene.cameras.front(), 16, 9);
    for (const SurfacePoint& point : points) {
        for (const Light& light : set.lights) {
            const float *c = light.sphere.center, r = light.sphere.range;
            const glm::vec3 d = point.position - glm::vec3(c[0], c[1], c[2]);
            affecting += glm::dot(d, d) < r * r ? 1u : 0u;
        }
    }
    const double mean = double(affecting) / double(points.size());
    EXPECT_GT(mean, 1.0);
    EXPECT_LT(mean, 10.0);
}

} // namespace
} // namespace manylights::lab
