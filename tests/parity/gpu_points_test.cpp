// The points that the renderer makes: against the scene's own software rasteriser, and against planes in closed form.

#include "lab/gpu/device.h"
#include "lab/renderer/renderer.h"
#include "lab/scene/error.h"
#include "tests/parity/validated_device.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

namespace manylights::lab {
namespace {

struct Size {
    std::uint32_t width, height;
};

std::string name_of(const Size& size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

// A wall across the view at a depth, much wider than it, facing away from the camera or towards it.
Scene wall(const Camera& camera, float depth, bool faces_away) {
    const CameraBasis basis = camera_basis(camera, 1, 1);
    Scene scene;
    const glm::vec3 center = camera.position + basis.forward * depth;
    const glm::vec3 normal = faces_away ? basis.forward : -basis.forward;
    const float far = 100.0f * depth;
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
        scene.vertices.push_back({center + (basis.right * corner.x + basis.up * corner.y) * far, normal, 1});
    scene.indices = {0, 1, 2, 0, 2, 3};
    scene.materials.resize(2);
    return scene;
}

Camera tilted_camera() {
    Camera camera;
    camera.position = {3.0f, -2.0f, 7.0f};
    camera.forward = glm::vec3(2.0f, 3.0f, 6.0f) / 7.0f;
    camera.near_plane = 0.25f;
    return camera;
}

class Points : public testing::TestWithParam<Size> {};

TEST_P(Points, of_a_wall_lie_on_it_and_under_their_pixels) {
    const auto [width, height] = GetParam();
    const Camera camera = tilted_camera();
    const CameraBasis basis = camera_basis(camera, width, height);
    for (const bool faces_away : {false, true}) {
        const Scene scene = wall(camera, 13.0f, faces_away);
        Renderer renderer(validated_device(), scene);
        const PointBuffer points = renderer.render_points(camera, width, height);
        const auto positions = points.download_positions();
        const auto normals = points.download_normals();
        ASSERT_EQ(positions.size(), std::size_t(width) * height);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const glm::vec3 p = positions[i].position;
            const float depth = glm::dot(p, basis.forward);
            ASSERT_NEAR(positions[i].depth, 13.0f, 13.0f * 1e-5f) << i;
            ASSERT_NEAR(depth, positions[i].depth, depth * 1e-6f) << i;
            const float x = (glm::dot(p, basis.right) / depth / basis.tan_half_x * 0.5f + 0.5f) * float(width);
            const float y = (-glm::dot(p, basis.up) / depth / basis.tan_half_y * 0.5f + 0.5f) * float(height);
            ASSERT_NEAR(x, float(i % width) + 0.5f, 1e-3f) << i;
            ASSERT_NEAR(y, float(i / width) + 0.5f, 1e-3f) << i;
            ASSERT_LT(glm::length(normals[i].normal + basis.forward), 1e-5f) << i;
            ASSERT_EQ(normals[i].material, 1u) << i;
        }
    }
    EXPECT_EQ(validated_device().validation_messages(), 0u);
}

TEST_P(Points, of_an_empty_scene_are_all_sky) {
    const auto [width, height] = GetParam();
    const Scene scene;
    Renderer renderer(validated_device(), scene);
    const PointBuffer points = renderer.render_points(tilted_camera(), width, height);
    for (const PointPosition& point : points.download_positions()) ASSERT_EQ(point.depth, 0.0f);
    for (const PointNormal& point : points.download_normals()) ASSERT_EQ(point.normal, glm::vec3(0.0f));
    EXPECT_EQ(validated_device().validation_messages(), 0u);
}

TEST_P(Points, of_the_cornell_box_agree_with_the_software_rasteriser) {
    const auto [width, height] = GetParam();
    const Scene scene = load_scene("cornell", Detail::low);
    Renderer renderer(validated_device(), scene);
    for (const Camera& camera : scene.cameras) {
        const auto positions = renderer.render_points(camera, width, height).download_positions();
        const auto expected = visible_points(scene, camera, width, height);
        // Pixels on an edge may fall to either side, or to the sky behind; all others must agree.
        std::size_t shaded = 0, matched = 0, next = 0;
        for (const PointPosition& point : positions) {
            if (!(point.depth > 0.0f)) continue;
            shaded += 1;
            for (std::size_t k = 0; k < 4 && next + k < expected.size(); ++k) {
                const glm::vec3 difference = expected[next + k].position - camera.position - point.position;
                if (glm::length(difference) > 2e-3f * point.depth) continue;
                next += k + 1;
                matched += 1;
                break;
            }
        }
        EXPECT_NEAR(double(shaded), double(expected.size()), 1.0 + 0.01 * double(expected.size())) << camera.name;
        EXPECT_GE(double(matched), 0.97 * double(shaded)) << camera.name << " of " << shaded;
    }
    EXPECT_EQ(validated_device().validation_messages(), 0u);
}

TEST(PointBuffer, refuses_an_image_without_pixels_and_one_too_large) {
    const std::vector<MaterialRecord> materials(1);
    EXPECT_THROW(PointBuffer(validated_device(), 0, 5, materials), InputError);
    EXPECT_THROW(PointBuffer(validated_device(), 5, 0, materials), InputError);
    if (validated_device().info().max_storage_buffer_range >= std::uint64_t(65536) * 65536 * 16) GTEST_SKIP();
    EXPECT_THROW(PointBuffer(validated_device(), 65536, 65536, materials), DeviceError);
}

TEST_P(Points, do_not_depend_on_what_the_buffers_held) {
    const auto [width, height] = GetParam();
    const Scene scene = load_scene("cornell", Detail::low);
    Renderer renderer(validated_device(), scene);
    PointBuffer points = renderer.render_points(scene.cameras[0], width, height);
    const auto positions = points.download_positions();
    const auto normals = points.download_normals();
    for (const std::uint32_t poison : {0xFFFFFFFFu, 0x3F800000u}) {
        points.positions().fill(poison);
        points.normals().fill(poison);
        renderer.render_points(scene.cameras[0], points);
        const auto positions_again = points.download_positions();
        const auto normals_again = points.download_normals();
        ASSERT_EQ(std::memcmp(positions.data(), positions_again.data(), points.positions().bytes()), 0);
        ASSERT_EQ(std::memcmp(normals.data(), normals_again.data(), points.normals().bytes()), 0);
    }
    EXPECT_EQ(validated_device().validation_messages(), 0u);
}

INSTANTIATE_TEST_SUITE_P(AwkwardSizes, Points, testing::Values(Size{1, 1}, Size{47, 33}, Size{48, 48}, Size{256, 144}),
                         [](const auto& parameter) { return name_of(parameter.param); });

} // namespace
} // namespace manylights::lab
