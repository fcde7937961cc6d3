#include "lab/scene/error.h"
#include "lab/scene/scene.h"
#include "tests/unit/scene/float_hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace manylights::lab {
namespace {

struct Case {
    const char* name;
    Detail detail;
    std::size_t most_triangles;
    std::uint64_t hash; ///< of all vertices, cameras and path frames
};

std::uint64_t hash_of(const Scene& scene) {
    FloatHash hash;
    for (const Vertex& v : scene.vertices) {
        hash.add({v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y, v.normal.z});
        hash.add(v.material);
    }
    for (const std::uint32_t index : scene.indices) hash.add(index);
    for (const auto& cameras : {scene.cameras, scene.path}) {
        for (const Camera& c : cameras)
            hash.add({c.position.x, c.position.y, c.position.z, c.forward.x, c.forward.y, c.forward.z});
    }
    return hash.value();
}

class BuiltinScene : public testing::TestWithParam<Case> {
  protected:
    const Scene scene = load_scene(GetParam().name, GetParam().detail);
};

TEST_P(BuiltinScene, HasSoundTriangles) {
    ASSERT_GT(scene.indices.size(), 0u);
    ASSERT_EQ(scene.indices.size() % 3, 0u);
    EXPECT_LE(scene.indices.size() / 3, GetParam().most_triangles);
    for (const std::uint32_t index : scene.indices) ASSERT_LT(index, scene.vertices.size());
    for (const Vertex& vertex : scene.vertices) {
        ASSERT_NEAR(glm::length(vertex.normal), 1.0f, 1e-5f);
        ASSERT_LT(vertex.material, scene.materials.size());
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_GE(vertex.position[axis], scene.bounds.lower[axis]);
            ASSERT_LE(vertex.position[axis], scene.bounds.upper[axis]);
        }
    }
}

TEST_P(BuiltinScene, FacesOutwardsWhereItsNormalsSay) {
    for (std::size_t i = 0; i < scene.indices.size(); i += 3) {
        const Vertex& a = scene.vertices[scene.indices[i]];
        const glm::vec3 b = scene.vertices[scene.indices[i + 1]].position,
                        c = scene.vertices[scene.indices[i + 2]].position;
        const glm::vec3 normal = glm::cross(b - a.position, c - a.position);
        ASSERT_GT(glm::dot(normal, a.normal), 0.99f * glm::length(normal));
    }
}

TEST_P(BuiltinScene, HasFourNamedCamerasAndSixteenFramesThatSeeGeometry) {
    ASSERT_GE(scene.cameras.size(), 4u);
    ASSERT_EQ(scene.path.size(), 16u);
    std::set<std::string> names;
    for (const Camera& camera : scene.cameras) names.insert(camera.name);
    EXPECT_EQ(names.size(), scene.cameras.size());
    std::vector<Camera> all = scene.cameras;
    all.insert(all.end(), scene.path.begin(), scene.path.end());
    for (const Camera& camera : all) {
        EXPECT_NEAR(glm::length(camera.forward), 1.0f, 1e-5f);
        const std::size_t seen = visible_points(scene, camera, 64, 36).size();
        EXPECT_GT(seen, 64u * 36u * 45 / 100) << camera.name << " sees mostly sky";
        std::size_t close = 0;
        for (const SurfacePoint& point : visible_points(scene, camera, 64, 36))
            close += glm::length(point.position - camera.position) < 0.4f ? 1 : 0;
        EXPECT_LT(close, seen / 4) << camera.name << " stands in front of a wall";
    }
}

TEST_P(BuiltinScene, HasOneSurfaceRulePerMaterialOrNone) {
    EXPECT_TRUE(scene.surface_rules.empty() || scene.surface_rules.size() == scene.materials.size());
    for (const SurfaceRule& rule : scene.surface_rules) {
        EXPECT_GE(rule.density, 0.0f);
        EXPECT_LE(rule.offset_lower, rule.offset_upper);
    }
}

TEST_P(BuiltinScene, IsTheSameOnEveryMachine) { EXPECT_EQ(hash_of(scene), GetParam().hash); }

INSTANTIATE_TEST_SUITE_P(All, BuiltinScene,
                         testing::Values(Case{"canyon", Detail::full, 300000, 0xcdf9ee7940bd1b1full},
                                         Case{"canyon", Detail::low, 19999, 0xfe1c332f3ca21513ull},
                                         Case{"citadel", Detail::full, 300000, 0x9e5a731da48af599ull},
                                         Case{"citadel", Detail::low, 19999, 0x803bcf6e27f6834dull},
                                         Case{"bars", Detail::full, 300000, 0x311a5664703859b6ull},
                                         Case{"bars", Detail::low, 19999, 0x855945bb67c46366ull},
                                         Case{"blocktown", Detail::full, 300000, 0xe8dc283c15bc6590ull},
                                         Case{"blocktown", Detail::low, 19999, 0x481dc6ec950a4dc8ull},
                                         Case{"cornell", Detail::full, 100, 0x47454ab81220bd19ull}),
                         [](const testing::TestParamInfo<Case>& test) {
                             return std::string(test.param.name) +
                                    (test.param.detail == Detail::low ? "_low" : "_full");
                         });

TEST(BuiltinScenes, HaveTheirPublishedSizes) {
    const Scene canyon = load_scene("canyon", Detail::low), citadel = load_scene("citadel", Detail::low),
                bars = load_scene("bars", Detail::low), cornell = load_scene("cornell");
    EXPECT_EQ(canyon.light_box.upper - canyon.light_box.lower, glm::vec3(200, 60, 600));
    EXPECT_EQ(canyon.bounds.upper - canyon.bounds.lower, glm::vec3(200, 60, 600));
    EXPECT_EQ(citadel.bounds.upper.x - citadel.bounds.lower.x, 3000.0f);
    EXPECT_EQ(citadel.bounds.upper.z - citadel.bounds.lower.z, 3000.0f);
    EXPECT_LE(citadel.bounds.upper.y, 180.0f);
    EXPECT_EQ(bars.light_box.upper - bars.light_box.lower, glm::vec3(400, 80, 400));
    EXPECT_EQ(cornell.bounds.upper - cornell.bounds.lower, glm::vec3(10, 10, 10));
    EXPECT_EQ(canyon.view_extent, 500.0f);
    EXPECT_EQ(citadel.view_extent, 3500.0f);
    EXPECT_EQ(citadel.radii.scale_cap, 2.0f);
    EXPECT_EQ(canyon.radii.scale_cap, 1.0f);
}

const Scene& blocktown() {
    static const Scene scene = load_scene("blocktown");
    return scene;
}

TEST(BuiltinScenes, BlocktownHasItsSizeItsGroupsAndWholeBlocks) {
    const Scene& scene = blocktown();
    EXPECT_EQ(scene.light_box.upper - scene.light_box.lower, glm::vec3(768, 128, 640));
    EXPECT_EQ(scene.bounds.upper.x - scene.bounds.lower.x, 768.0f);
    EXPECT_EQ(scene.bounds.upper.z - scene.bounds.lower.z, 640.0f);
    EXPECT_LE(scene.bounds.upper.y, 128.0f);
    EXPECT_EQ(scene.view_extent, 1000.0f);
    EXPECT_EQ(scene.distribution, "groups");
    EXPECT_EQ(load_scene("canyon", Detail::low).distribution, "volume");
    for (const Vertex& vertex : scene.vertices) {
        ASSERT_EQ(vertex.position, glm::floor(vertex.position)) << "not on the grid of blocks";
    }
}

TEST(BuiltinScenes, BlocktownIsSeenFromFarAtTheStartTheMiddleAndTheEnd) {
    const Scene& scene = blocktown();
    const auto mean_distance = [&](std::size_t frame) {
        double sum = 0.0;
        const std::vector<SurfacePoint> points = visible_points(scene, scene.path[frame], 64, 36);
        for (const SurfacePoint& point : points) sum += glm::length(point.position - scene.path[frame].position);
        return sum / double(points.size());
    };
    for (const std::size_t frame : {0u, 1u, 7u, 8u, 14u, 15u}) EXPECT_GT(mean_distance(frame), 200.0) << frame;
    for (const std::size_t frame : {2u, 3u, 4u, 5u, 6u, 9u, 10u, 11u, 12u, 13u})
        EXPECT_LT(mean_distance(frame), 100.0) << frame;
}

TEST(BuiltinScenes, AreListedAndOthersRefusedByName) {
    for (const SceneInfo& info : builtin_scenes()) EXPECT_EQ(load_scene(info.name, Detail::low).name, info.name);
    try {
        load_scene("valley");
        ADD_FAILURE() << "an unknown scene was accepted";
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("valley"), std::string::npos);
        for (const SceneInfo& info : builtin_scenes()) EXPECT_NE(message.find(info.name), std::string::npos);
        EXPECT_EQ(message.find('\n'), std::string::npos);
    }
}

} // namespace
} // namespace manylights::lab
