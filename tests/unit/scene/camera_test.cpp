#include "lab/scene/camera.h"
#include "lab/scene/error.h"
#include "lab/scene/scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace manylights::lab {
namespace {

Camera tilted_camera() {
    Camera camera;
    camera.position = {3.0f, -2.0f, 7.0f};
    camera.forward = glm::normalize(glm::vec3(1.0f, -0.4f, -2.0f));
    camera.vertical_fov = 0.9f;
    camera.near_plane = 0.25f;
    return camera;
}

/// Column-major matrix times column vector.
std::array<double, 4> transform(const float* m, const std::array<double, 4>& v) {
    std::array<double, 4> result{};
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) result[row] += double(m[4 * column + row]) * v[column];
    }
    return result;
}

std::array<double, 4> project(const ManylightsView& view, const glm::vec3& p) {
    return transform(view.clip_from_view, transform(view.view_from_world, {p.x, p.y, p.z, 1.0}));
}

TEST(Camera, BasisIsOrthonormalAndRightHanded) {
    const CameraBasis basis = camera_basis(tilted_camera(), 640, 360);
    EXPECT_NEAR(glm::dot(basis.right, basis.right), 1.0f, 1e-6f);
    EXPECT_NEAR(glm::dot(basis.up, basis.up), 1.0f, 1e-6f);
    EXPECT_NEAR(glm::dot(basis.right, basis.up), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::dot(glm::cross(basis.right, basis.up), basis.forward), -1.0f, 1e-6f);
    EXPECT_GT(basis.up.y, 0.0f);
}

TEST(Camera, ImageExtentMatchesTheTangent) {
    for (const float fov : {0.02f, 0.5f, 1.04719755f, 1.6f, 2.9f}) {
        Camera camera = tilted_camera();
        camera.vertical_fov = fov;
        const CameraBasis basis = camera_basis(camera, 1920, 1080);
        const double expected = std::tan(0.5 * double(fov));
        EXPECT_NEAR(basis.tan_half_y, expected, 1e-6 * expected);
        EXPECT_NEAR(basis.tan_half_x, expected * 1920.0 / 1080.0, 1e-6 * 2.0 * expected);
    }
}

TEST(Camera, ViewProjectsToVulkanClipSpaceWithReversedInfiniteDepth) {
    const Camera camera = tilted_camera();
    const ManylightsView view = make_view(camera, 640, 360);
    const CameraBasis basis = camera_basis(camera, 640, 360);
    const float depth = 12.0f;
    const glm::vec3 ahead = camera.position + basis.forward * depth;
    const auto center = project(view, ahead);
    EXPECT_NEAR(center[0] / center[3], 0.0, 1e-5);
    EXPECT_NEAR(center[1] / center[3], 0.0, 1e-5);
    EXPECT_NEAR(center[3], depth, 1e-4);
    EXPECT_NEAR(center[2] / center[3], camera.near_plane / depth, 1e-6);
    const auto corner =
        project(view, ahead + basis.right * (depth * basis.tan_half_x) + basis.up * (depth * basis.tan_half_y));
    EXPECT_NEAR(corner[0] / corner[3], 1.0, 1e-5);
    EXPECT_NEAR(corner[1] / corner[3], -1.0, 1e-5) << "up must be the image's first row";
    EXPECT_EQ(view.size, sizeof(ManylightsView));
    EXPECT_EQ(view.width, 640u);
    EXPECT_EQ(view.height, 360u);
    EXPECT_EQ(view.clip_y_up, 0u);
}

TEST(FindCamera, TakesNamesAndPathParameters) {
    const Scene scene = load_scene("cornell");
    EXPECT_EQ(find_camera(scene, "").name, scene.cameras.front().name);
    EXPECT_EQ(find_camera(scene, "high").name, "high");
    EXPECT_EQ(find_camera(scene, "path:0").position, scene.path.front().position);
    EXPECT_EQ(find_camera(scene, "path:0.5").position, scene.path[8].position);
    const glm::vec3 halfway = find_camera(scene, "path:0.03125").position;
    const glm::vec3 expected = 0.5f * (scene.path[0].position + scene.path[1].position);
    EXPECT_LT(glm::length(halfway - expected), 1e-5f);
    EXPECT_EQ(find_camera(scene, "path:0.999").position, scene.path.back().position);
}

TEST(FindCamera, NamesTheChoicesWhenThereIsNoSuchCamera) {
    const Scene scene = load_scene("cornell");
    for (const char* selector :
         {"nonsense", "path", "path:", "path:1", "path:-0.1", "path:nan", "path:0.5x", "path:inf"}) {
        try {
            find_camera(scene, selector);
            ADD_FAILURE() << selector << " was accepted";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(selector), std::string::npos) << error.what();
        }
    }
}

} // namespace
} // namespace manylights::lab
