#include "lab/scene/error.h"
#include "lab/scene/lights.h"
#include "lab/scene/scene.h"
#include "tests/unit/scene/float_hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace manylights::lab {
namespace {

glm::vec3 center(const Light& light) {
    return {light.sphere.center[0], light.sphere.center[1], light.sphere.center[2]};
}

LightSet lights(const Scene& scene, const char* distribution, std::uint32_t count, std::uint32_t seed = 1,
                const char* radius = "2:8") {
    return make_lights(scene, scene.cameras.front(), {count, distribution, seed, radius});
}

const Scene& cornell() {
    static const Scene scene = load_scene("cornell");
    return scene;
}

const Scene& citadel() {
    static const Scene scene = load_scene("citadel", Detail::low);
    return scene;
}

struct Case {
    const char* distribution;
    std::uint64_t hash; ///< of 2,000 positions and radii in canyon
};

class Distribution : public testing::TestWithParam<Case> {
  protected:
    const Scene scene = load_scene("canyon", Detail::low);
    const char* name = GetParam().distribution;
};

TEST_P(Distribution, MakesAsManyAsAsked) {
    for (const std::uint32_t count : {0u, 1u, 31u, 1234u}) EXPECT_EQ(lights(scene, name, count).lights.size(), count);
}

TEST_P(Distribution, IsAPrefixOfALargerOne) {
    for (const char* radius : {"2:8", "mix", "auto"}) {
        const LightSet few = lights(scene, name, 1024, 7, radius), many = lights(scene, name, 4096, 7, radius);
        for (std::size_t i = 0; i < few.lights.size(); ++i) {
            ASSERT_EQ(center(few.lights[i]), center(many.lights[i])) << radius << ", light " << i;
            ASSERT_NEAR(few.lights[i].sphere.range / few.radius_scale, many.lights[i].sphere.range / many.radius_scale,
                        1e-4f);
        }
    }
}

TEST_P(Distribution, DependsOnTheSeed) {
    const LightSet one = lights(scene, name, 100, 1), two = lights(scene, name, 100, 2);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_NE(center(one.lights[i]), center(two.lights[i]));
}

TEST_P(Distribution, HasFiniteLightsOfAnyColor) {
    for (const Light& light : lights(scene, name, 5000, 3, "auto").lights) {
        ASSERT_TRUE(std::isfinite(light.sphere.center[0] + light.sphere.center[1] + light.sphere.center[2]));
        ASSERT_GT(light.sphere.range, 0.0f);
        ASSERT_LT(light.sphere.range, 100.0f);
        for (const float c : light.color) ASSERT_TRUE(c > 0.0f && std::isfinite(c));
    }
}

TEST_P(Distribution, IsTheSameOnEveryMachine) {
    FloatHash hash;
    for (const Light& light : lights(scene, name, 2000, 1, "mix").lights)
        hash.add({light.sphere.center[0], light.sphere.center[1], light.sphere.center[2], light.sphere.range});
    EXPECT_EQ(hash.value(), GetParam().hash);
}

INSTANTIATE_TEST_SUITE_P(All, Distribution,
                         testing::Values(Case{"volume", 0x013cf862464a96b2ull}, Case{"surface", 0xbffb48b22f09c222ull},
                                         Case{"surface-largest", 0xea49059a2c5191beull},
                                         Case{"groups", 0xddbab4d2ecb9e95bull}, Case{"view", 0x56426e02bae7367full}),
                         [](const testing::TestParamInfo<Case>& test) {
                             std::string name = test.param.distribution;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(VolumeDistribution, IsUniformInTheLightBox) {
    const Scene scene = load_scene("bars", Detail::low);
    const LightSet set = lights(scene, "volume", 50'000);
    glm::dvec3 sum(0.0), squares(0.0);
    for (const Light& light : set.lights) {
        const glm::vec3 p = center(light);
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(p, scene.light_box.lower)) &&
                    glm::all(glm::lessThanEqual(p, scene.light_box.upper)));
        const glm::dvec3 unit =
            glm::dvec3(p - scene.light_box.lower) / glm::dvec3(scene.light_box.upper - scene.light_box.lower);
        sum += unit;
        squares += unit * unit;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double mean = sum[axis] / 50'000.0;
        EXPECT_NEAR(mean, 0.5, 0.006); // 4.6 standard errors
        EXPECT_NEAR(squares[axis] / 50'000.0 - mean * mean, 1.0 / 12.0, 0.0017);
    }
}

TEST(SurfaceDistribution, LiesAQuarterOfTheRadiusAboveTrianglesByArea) {
    // The walls, floor and ceiling of the box have 100 each of its 500 + 126 of the two boxes in it.
    const LightSet set = lights(cornell(), "surface", 40'000, 1, "0.2:1");
    int on_floor = 0;
    for (const Light& light : set.lights) {
        const glm::vec3 p = center(light);
        if (std::fabs(p.y - 0.25f * light.sphere.range) < 1e-5f) ++on_floor;
    }
    double area = 0.0;
    for (std::size_t i = 0; i < cornell().indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return cornell().vertices[cornell().indices[i + k]].position; };
        area += 0.5 * double(glm::length(glm::cross(at(1) - at(0), at(2) - at(0))));
    }
    EXPECT_NEAR(on_floor / 40'000.0, 100.0 / area, 0.01);
}

TEST(SurfaceDistribution, FollowsTheRulesOfTheScene) {
    const Scene& scene = citadel();
    const LightSet set = lights(scene, "surface", 20'000, 1, "auto");
    int inner = 0, outer = 0;
    for (const Light& light : set.lights) {
        const glm::vec3 p = center(light);
        const float away = std::max(std::fabs(p.x), std::fabs(p.z));
        ASSERT_LT(away, 1510.0f);
        (away < 750.0f ? inner : outer) += 1;
    }
    // The inner quarter of the area holds more than a quarter of the lights, because they crowd around the centre.
    EXPECT_GT(inner, (inner + outer) * 32 / 100);
}

TEST(SurfaceDistribution, PutsLightsWhereTheirMaterialSays) {
    // One street and one wall: offsets 2 to 6 m and 0.3 to 2.5 m.
    Scene scene;
    scene.materials.resize(2);
    scene.surface_rules = {{1.0f, 2.0f, 6.0f}, {3.0f, 0.3f, 2.5f}};
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, std::uint32_t material) {
        for (const glm::vec3& p : {a, b, c}) {
            scene.indices.push_back(std::uint32_t(scene.vertices.size()));
            scene.vertices.push_back({p, glm::normalize(glm::cross(b - a, c - a)), material});
        }
    };
    add({0, 0, 0}, {0, 0, 10}, {10, 0, 0}, 0);
    add({100, 0, 0}, {110, 0, 0}, {100, 10, 0}, 1);
    add({5, 5, 5}, {5, 5, 5}, {6, 6, 6}, 1); // no area: never chosen
    scene.cameras.emplace_back();
    const LightSet set = lights(scene, "surface", 4000);
    int on_street = 0;
    for (const Light& light : set.lights) {
        const glm::vec3 p = center(light);
        if (p.x < 50.0f) {
            ++on_street;
            ASSERT_TRUE(p.y >= 2.0f && p.y <= 6.0f);
            ASSERT_TRUE(p.x >= 0.0f && p.z >= 0.0f && p.x + p.z <= 10.001f);
        } else {
            ASSERT_TRUE(p.z >= 0.3f && p.z <= 2.5f);
        }
    }
    EXPECT_NEAR(on_street, 1000, 130); // equal areas, a third of the density
}

TEST(SurfaceLargestDistribution, UsesTheThousandLargestTrianglesOnly) {
    Scene scene;
    scene.materials.resize(1);
    for (int i = 0; i < 1100; ++i) {
        const float size = i < 1000 ? 2.0f : 1.9f, x = 10.0f * float(i);
        for (const glm::vec3 p : {glm::vec3(x, 0, 0), glm::vec3(x, 0, size), glm::vec3(x + size, 0, 0)}) {
            scene.indices.push_back(std::uint32_t(scene.vertices.size()));
            scene.vertices.push_back({p, {0, 1, 0}, 0});
        }
    }
    scene.cameras.emplace_back();
    for (const Light& light : lights(scene, "surface-largest", 20'000).lights) {
        ASSERT_LT(light.sphere.center[0], 10'000.0f);
        ASSERT_TRUE(light.sphere.center[1] >= 0.0f && light.sphere.center[1] <= 0.5f * light.sphere.range);
    }
}

TEST(GroupsDistribution, ScattersNormallyAroundAThousandCenters) {
    const Scene scene = load_scene("canyon", Detail::low);
    const glm::vec3 size = scene.light_box.upper - scene.light_box.lower;
    const double reach = 0.015 * double(glm::length(size)), sigma = 0.5 * reach;
    const std::uint32_t count = 100'000;
    const LightSet set = lights(scene, "groups", count);
    double squares = 0.0;
    for (std::uint32_t group = 0; group < 1000; ++group) {
        glm::dvec3 mean(0.0);
        for (std::uint32_t i = group; i < count; i += 1000) mean += glm::dvec3(center(set.lights[i])) / 100.0;
        for (std::uint32_t i = group; i < count; i += 1000) {
            const glm::dvec3 off = glm::dvec3(center(set.lights[i])) - mean;
            ASSERT_LT(std::max({std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)}), 2.0 * reach);
            squares += glm::dot(off, off);
        }
        // The group's centre lies in the box, and so does its mean, nearly.
        ASSERT_TRUE(glm::all(glm::greaterThan(mean, glm::dvec3(scene.light_box.lower) - 0.5 * reach)));
    }
    const double variance = squares / (3.0 * 99.0 * 1000.0);
    EXPECT_NEAR(variance / (sigma * sigma), 0.7737, 0.01);
}

TEST(ViewDistribution, IsUniformInViewDepthInsideTheFrustum) {
    const Scene scene = load_scene("canyon", Detail::low);
    const CameraBasis basis = camera_basis(scene.cameras.front(), 16, 9);
    double sum = 0.0;
    const LightSet set = lights(scene, "view", 20'000, 1, "auto");
    for (const Light& light : set.lights) {
        const glm::vec3 from_eye = center(light) - scene.cameras.front().position;
        const float depth = glm::dot(from_eye, basis.forward);
        ASSERT_TRUE(depth > 0.999f && depth < 201.01f);
        ASSERT_LE(std::fabs(glm::dot(from_eye, basis.right)), depth * basis.tan_half_x * 1.001f);
        ASSERT_LE(std::fabs(glm::dot(from_eye, basis.up)), depth * basis.tan_half_y * 1.001f);
        ASSERT_TRUE(light.sphere.range >= 0.5f && light.sphere.range <= 5.0f);
        sum += double(depth);
    }
    EXPECT_NEAR(sum / 20'000.0, 101.0, 2.0);
    EXPECT_EQ(set.radius_scale, 1.0f);
}

TEST(FileDistribution, NeedsLightsInTheFileAndKeepsTheirOwnRange) {
    EXPECT_THROW(lights(cornell(), "file", 10, 1, "auto"), InputError);
    Scene scene = cornell();
    scene.lights.resize(3);
    for (std::size_t i = 0; i < 3; ++i) scene.lights[i].sphere.range = float(i + 1);
    const LightSet all = lights(scene, "file", 65536, 1, "auto");
    ASSERT_EQ(all.lights.size(), 3u);
    EXPECT_EQ(all.lights[2].sphere.range, 3.0f);
    EXPECT_EQ(lights(scene, "file", 2, 1, "auto").lights.size(), 2u);
    EXPECT_THROW(lights(scene, "file", 3, 1, "mix"), InputError);
}

TEST(Distributions, AreListedAndOthersRefusedByName) {
    EXPECT_EQ(distributions().size(), 6u);
    try {
        lights(cornell(), "everywhere", 10);
        ADD_FAILURE() << "an unknown distribution was accepted";
    } catch (const InputError& error) {
        for (const DistributionInfo& info : distributions())
            EXPECT_NE(std::string(error.what()).find(info.name), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace manylights::lab
