#include "lab/scene/generated_cameras.h"

#include <gtest/gtest.h>

namespace manylights::lab {
namespace {

/// The cornell box as a file without cameras would bring it.
Scene without_cameras(const char* name) {
    Scene scene = load_scene(name, Detail::low);
    scene.cameras.clear();
    scene.path.clear();
    return scene;
}

bool contains(const Box& box, const glm::vec3& p) {
    return glm::all(glm::greaterThan(p, box.lower)) && glm::all(glm::lessThan(p, box.upper));
}

TEST(GeneratedCameras, StandInsideARoom) {
    Scene scene = without_cameras("cornell");
    add_generated_cameras(scene);
    ASSERT_EQ(scene.cameras.size(), 4u);
    ASSERT_EQ(scene.path.size(), 16u);
    for (const Camera& camera : scene.cameras) EXPECT_TRUE(contains(scene.bounds, camera.position)) << camera.name;
    for (const Camera& camera : scene.path) EXPECT_TRUE(contains(scene.bounds, camera.position));
}

TEST(GeneratedCameras, StandAroundALoneObject) {
    Scene scene;
    scene.materials.emplace_back();
    const glm::vec3 corners[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::uint32_t faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    for (const std::uint32_t corner : faces) {
        scene.indices.push_back(std::uint32_t(scene.vertices.size()));
        scene.vertices.push_back({corners[corner], {0, 1, 0}, 0});
    }
    scene.bounds = {{0, 0, 0}, {1, 1, 1}};
    add_generated_cameras(scene);
    ASSERT_EQ(scene.cameras.size(), 4u);
    for (const Camera& camera : scene.cameras) {
        EXPECT_FALSE(contains(scene.bounds, camera.position));
        EXPECT_GT(visible_points(scene, camera, 64, 36).size(), 30u) << camera.name;
    }
}

TEST(GeneratedCameras, FillUpThoseOfTheFile) {
    Scene scene = without_cameras("cornell");
    Camera own;
    own.name = "own";
    scene.cameras.push_back(own);
    add_generated_cameras(scene);
    ASSERT_EQ(scene.cameras.size(), 4u);
    EXPECT_EQ(scene.cameras.front().name, "own");
}

TEST(GeneratedCameras, CopeWithOneFlatTriangle) {
    Scene scene;
    scene.materials.emplace_back();
    for (const glm::vec3 corner : {glm::vec3(0, 0, 0), glm::vec3(0, 0, 1), glm::vec3(1, 0, 0)}) {
        scene.indices.push_back(std::uint32_t(scene.vertices.size()));
        scene.vertices.push_back({corner, {0, 1, 0}, 0});
    }
    scene.bounds = {{0, 0, 0}, {1, 0, 1}};
    add_generated_cameras(scene);
    EXPECT_EQ(scene.cameras.size(), 4u);
    EXPECT_GT(visible_points(scene, scene.cameras[0], 64, 36).size(), 10u);
}

} // namespace
} // namespace manylights::lab
