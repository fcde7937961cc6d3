#include "lab/techniques/light_volumes/proxy_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace manylights::lab {

namespace {

using Triangle = std::array<glm::dvec3, 3>;

// With the golden ratio the corners of three rectangles, each upright on the two others.
std::vector<Triangle> icosahedron() {
    const double g = 0.5 * (1.0 + std::sqrt(5.0));
    const glm::dvec3 corners[] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    constexpr int kFaces[][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    std::vector<Triangle> triangles;
    for (const auto& face : kFaces)
        triangles.push_back(
            {glm::normalize(corners[face[0]]), glm::normalize(corners[face[1]]), glm::normalize(corners[face[2]])});
    return triangles;
}

std::vector<Triangle> divided(const std::vector<Triangle>& triangles) {
    std::vector<Triangle> parts;
    for (const auto& [a, b, c] : triangles) {
        // A sum of two is the same in either order, so neighbours get the same corner.
        const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
        parts.insert(parts.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    return parts;
}

double distance_of_plane(const Triangle& t) {
    return glm::dot(glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0])), t[0]);
}

} // namespace

ProxyMesh make_proxy_mesh(std::uint32_t level) {
    std::vector<Triangle> triangles = icosahedron();
    for (std::uint32_t i = 0; i < level; ++i) triangles = divided(triangles);
    double inside = 1.0;
    for (const Triangle& triangle : triangles) inside = std::min(inside, distance_of_plane(triangle));
    ProxyMesh mesh{{}, static_cast<float>(1.0 / inside)};
    for (const Triangle& triangle : triangles)
        for (const glm::dvec3& corner : triangle) mesh.corners.emplace_back(glm::vec3(corner / inside), 0.0f);
    return mesh;
}

} // namespace manylights::lab
