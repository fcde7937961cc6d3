#include "lab/scene/random.h"
#include "lab/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace manylights::lab {
namespace {

void add_triangle(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                  std::uint32_t material = 0) {
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    for (const glm::vec3& p : {a, b, c}) {
        scene.indices.push_back(std::uint32_t(scene.vertices.size()));
        scene.vertices.push_back({p, normal, material});
    }
}

/// Nearest hit along the pixel's ray, in double: depth, or nothing.
std::optional<double> trace(const Scene& scene, const Camera& camera, const glm::dvec3& ray) {
    std::optional<double> nearest;
    for (std::size_t i = 0; i < scene.indices.size(); i += 3) {
        const glm::dvec3 eye(camera.position), a(scene.vertices[scene.indices[i]].position),
            ab = glm::dvec3(scene.vertices[scene.indices[i + 1]].position) - a,
            ac = glm::dvec3(scene.vertices[scene.indices[i + 2]].position) - a;
        const glm::dvec3 p = glm::cross(ray, ac);
        const double determinant = glm::dot(ab, p);
        if (determinant == 0.0) continue;
        const glm::dvec3 s = eye - a, q = glm::cross(s, ab);
        const double u = glm::dot(s, p) / determinant, v = glm::dot(ray, q) / determinant;
        const double depth = glm::dot(ac, q) / determinant;
        if (u < 0.0 || v < 0.0 || u + v > 1.0 || depth < double(camera.near_plane)) continue;
        if (!nearest || depth < *nearest) nearest = depth;
    }
    return nearest;
}

TEST(VisiblePoints, AgreeWithRays) {
    Scene scene;
    for (std::uint32_t i = 0; i < 60; ++i) {
        const auto corner = [&](std::uint32_t c) {
            return glm::vec3(random_between(5, i, c, -8.0f, 8.0f), random_between(5, i, c + 1, -6.0f, 6.0f),
                             random_between(5, i, c + 2, -20.0f, 4.0f)); // partly behind the camera
        };
        add_triangle(scene, corner(0), corner(3), corner(6));
    }
    Camera camera;
    camera.near_plane = 0.5f;
    const std::uint32_t width = 80, height = 45;
    const CameraBasis basis = camera_basis(camera, width, height);
    const std::vector<SurfacePoint> points = visible_points(scene, camera, width, height);
    std::size_t next = 0, compared = 0, differing = 0;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const double right = ((x + 0.5) / width * 2.0 - 1.0) * double(basis.tan_half_x);
            const double up = (1.0 - (y + 0.5) / height * 2.0) * double(basis.tan_half_y);
            const auto depth = trace(scene, camera, glm::dvec3(right, up, -1.0));
            if (!depth) continue;
            ++compared;
            // A pixel centre exactly on an edge may fall to either side; nothing else may differ.
            const glm::vec3 expected(right * *depth, up * *depth, -*depth);
            if (next < points.size() && glm::length(points[next].position - expected) < 1e-3f)
                ++next;
            else
                ++differing;
        }
    }
    EXPECT_GT(compared, 1000u);
    EXPECT_LE(differing, 2u);
    EXPECT_NEAR(double(points.size()), double(compared), 2.0);
}

TEST(VisiblePoints, CarryTheNormalOfTheSideThatIsSeenAndTheMaterial) {
    Scene scene;
    add_triangle(scene, {-50, -50, -5}, {50, -50, -5}, {0, 90, -5}, 3);
    Camera camera;
    for (const SurfacePoint& point : visible_points(scene, camera, 16, 9)) {
        EXPECT_EQ(point.normal, glm::vec3(0, 0, 1));
        EXPECT_EQ(point.material, 3u);
    }
    camera.position = {0, 0, -10};
    camera.forward = {0, 0, 1};
    const auto behind = visible_points(scene, camera, 16, 9);
    ASSERT_EQ(behind.size(), 16u * 9u);
    EXPECT_EQ(behind[0].normal, glm::vec3(0, 0, -1));
}

TEST(VisiblePoints, SeeNothingInAnEmptyOrHiddenScene) {
    Scene scene;
    EXPECT_TRUE(visible_points(scene, Camera(), 16, 9).empty());
    add_triangle(scene, {-1, -1, 5}, {1, -1, 5}, {0, 1, 5}); // behind
    EXPECT_TRUE(visible_points(scene, Camera(), 16, 9).empty());
}

} // namespace
} // namespace manylights::lab
