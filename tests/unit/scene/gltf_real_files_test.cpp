// Real scenes, where they lie beside the repository.

#include "lab/scene/scene.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace manylights::lab {
namespace {

struct Case {
    const char* name;
    const char* path;
    std::size_t triangles; ///< at least
    bool indoor;           ///< generated cameras must stand inside and see no sky to speak of
};

class RealFile : public testing::TestWithParam<Case> {
  protected:
    std::string path() const { return std::string(MANYLIGHTS_SOURCE_DIR) + "/../shared/scenes/" + GetParam().path; }
    void SetUp() override {
        if (!std::filesystem::exists(path())) GTEST_SKIP() << path() << " is not there";
    }
};

TEST_P(RealFile, LoadsAndIsSeen) {
    const Scene scene = load_scene(path());
    EXPECT_GE(scene.indices.size() / 3, GetParam().triangles);
    for (const Vertex& vertex : scene.vertices) ASSERT_NEAR(glm::length(vertex.normal), 1.0f, 1e-4f);
    ASSERT_GE(scene.cameras.size(), 4u);
    ASSERT_EQ(scene.path.size(), 16u);
    for (const Camera& camera : scene.cameras) {
        const std::size_t seen = visible_points(scene, camera, 64, 36).size();
        EXPECT_GT(seen, GetParam().indoor ? 64u * 36u * 9 / 10 : 64u) << camera.name;
    }
}

TEST_P(RealFile, IsLitByAboutSixLights) {
    const Scene scene = load_scene(path());
    for (const char* distribution : {"volume", "surface"}) {
        const LightSet set = make_lights(scene, scene.cameras.front(), {16384, distribution, 1, "auto"});
        EXPECT_LT(set.radius_scale, 1.0f) << distribution;
        EXPECT_GT(set.radius_scale, 0.01f) << distribution;
    }
}

INSTANTIATE_TEST_SUITE_P(All, RealFile,
                         testing::Values(Case{"sponza", "sponza/sponza.glb", 260'000, true},
                                         Case{"arena_city", "arena_city/arena_city.glb", 430'000, false},
                                         Case{"truck_town", "truck_town/town.glb", 30'000, false},
                                         Case{"racing_track", "racing_track/track.glb", 110'000, false},
                                         Case{"lamp", "lamp_punctual/LightsPunctualLamp.gltf", 6'000, false},
                                         Case{"cornell", "cornell/cornellBox.glb", 4'000, false},
                                         Case{"transmission", "transparency/TransmissionTest.glb", 120'000, false}),
                         [](const testing::TestParamInfo<Case>& test) { return test.param.name; });

TEST(RealFiles, LampHasItsFivePointLights) {
    const std::string path =
        std::string(MANYLIGHTS_SOURCE_DIR) + "/../shared/scenes/lamp_punctual/LightsPunctualLamp.gltf";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    EXPECT_EQ(load_scene(path).lights.size(), 5u);
}

} // namespace
} // namespace manylights::lab
