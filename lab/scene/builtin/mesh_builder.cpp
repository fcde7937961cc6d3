#include "lab/scene/builtin/mesh_builder.h"

#include <cmath>

namespace manylights::lab {

std::uint32_t MeshBuilder::material(glm::vec3 base_color, float roughness, float metallic) {
    scene_.materials.push_back({base_color, roughness, metallic, glm::vec3(0.0f)});
    return std::uint32_t(scene_.materials.size() - 1);
}

void MeshBuilder::triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c, std::uint32_t material) {
    const glm::vec3 normal = glm::cross(b - a, c - a);
    const float length = std::sqrt(glm::dot(normal, normal));
    if (!(length > 0.0f)) return;
    const auto first = std::uint32_t(scene_.vertices.size());
    for (const glm::vec3& position : {a, b, c}) scene_.vertices.push_back({position, normal / length, material});
    scene_.indices.insert(scene_.indices.end(), {first, first + 1, first + 2});
}

void MeshBuilder::quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, std::uint32_t material) {
    const glm::vec3 normal = glm::cross(c - a, d - b);
    const float length = std::sqrt(glm::dot(normal, normal));
    if (!(length > 0.0f)) return;
    const auto first = std::uint32_t(scene_.vertices.size());
    for (const glm::vec3& position : {a, b, c, d}) scene_.vertices.push_back({position, normal / length, material});
    scene_.indices.insert(scene_.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

void MeshBuilder::box(glm::vec3 lower, glm::vec3 upper, unsigned sides, std::uint32_t material) {
    box(lower, upper, sides, material, material);
}

void MeshBuilder::box(glm::vec3 l, glm::vec3 u, unsigned sides, std::uint32_t side_material,
                      std::uint32_t top_material) {
    if (sides & kSideNegativeX) quad({l.x, l.y, l.z}, {l.x, l.y, u.z}, {l.x, u.y, u.z}, {l.x, u.y, l.z}, side_material);
    if (sides & kSidePositiveX) quad({u.x, l.y, u.z}, {u.x, l.y, l.z}, {u.x, u.y, l.z}, {u.x, u.y, u.z}, side_material);
    if (sides & kSideNegativeZ) quad({u.x, l.y, l.z}, {l.x, l.y, l.z}, {l.x, u.y, l.z}, {u.x, u.y, l.z}, side_material);
    if (sides & kSidePositiveZ) quad({l.x, l.y, u.z}, {u.x, l.y, u.z}, {u.x, u.y, u.z}, {l.x, u.y, u.z}, side_material);
    if (sides & kSideTop) quad({l.x, u.y, u.z}, {u.x, u.y, u.z}, {u.x, u.y, l.z}, {l.x, u.y, l.z}, top_material);
    if (sides & kSideBottom) quad({l.x, l.y, l.z}, {u.x, l.y, l.z}, {u.x, l.y, u.z}, {l.x, l.y, u.z}, side_material);
}

void MeshBuilder::bevelled_box(glm::vec3 l, glm::vec3 u, float bevel, unsigned bevelled, std::uint32_t side_material,
                               std::uint32_t top_material) {
    const float y = u.y - bevel;
    box(l, {u.x, y, u.z}, kSidesAround | kSideBottom, side_material);
    // The top is drawn in on the bevelled sides only; on the others the slope below degenerates to an upright
    // trapezoid, which closes the gap at the corners.
    const glm::vec3 tl(l.x + (bevelled & kSideNegativeX ? bevel : 0.0f), u.y,
                       l.z + (bevelled & kSideNegativeZ ? bevel : 0.0f));
    const glm::vec3 tu(u.x - (bevelled & kSidePositiveX ? bevel : 0.0f), u.y,
                       u.z - (bevelled & kSidePositiveZ ? bevel : 0.0f));
    quad({l.x, y, l.z}, {l.x, y, u.z}, {tl.x, u.y, tu.z}, {tl.x, u.y, tl.z}, top_material);
    quad({u.x, y, u.z}, {u.x, y, l.z}, {tu.x, u.y, tl.z}, {tu.x, u.y, tu.z}, top_material);
    quad({u.x, y, l.z}, {l.x, y, l.z}, {tl.x, u.y, tl.z}, {tu.x, u.y, tl.z}, top_material);
    quad({l.x, y, u.z}, {u.x, y, u.z}, {tu.x, u.y, tu.z}, {tl.x, u.y, tu.z}, top_material);
    quad({tl.x, u.y, tu.z}, {tu.x, u.y, tu.z}, {tu.x, u.y, tl.z}, {tl.x, u.y, tl.z}, top_material);
}

void MeshBuilder::tower(glm::vec3 center, float radius, float top_radius, float height, unsigned corners, bool top,
                        std::uint32_t material) {
    // The unit circle in its rational parametrisation: nearly regular corners without a maths library.
    const auto corner = [&](unsigned k) {
        const unsigned quarter = corners / 4;
        const float t = float(k % quarter) / float(quarter);
        const float c = (1.0f - t * t) / (1.0f + t * t), s = 2.0f * t / (1.0f + t * t);
        switch ((k / quarter) % 4) {
        case 0:
            return glm::vec3(c, 0.0f, s);
        case 1:
            return glm::vec3(-s, 0.0f, c);
        case 2:
            return glm::vec3(-c, 0.0f, -s);
        default:
            return glm::vec3(s, 0.0f, -c);
        }
    };
    const glm::vec3 lift(0.0f, height, 0.0f);
    for (unsigned k = 0; k < corners; ++k) {
        const glm::vec3 a = corner(k), b = corner(k + 1);
        if (top_radius > 0.0f) {
            quad(center + b * radius, center + a * radius, center + lift + a * top_radius,
                 center + lift + b * top_radius, material);
            if (top) triangle(center + lift, center + lift + b * top_radius, center + lift + a * top_radius, material);
        } else {
            triangle(center + b * radius, center + a * radius, center + lift, material);
        }
    }
}

void MeshBuilder::gabled_roof(glm::vec3 l, glm::vec3 u, bool ridge_along_x, std::uint32_t roof_material,
                              std::uint32_t gable_material) {
    if (ridge_along_x) {
        const float z = 0.5f * (l.z + u.z);
        quad({l.x, l.y, u.z}, {u.x, l.y, u.z}, {u.x, u.y, z}, {l.x, u.y, z}, roof_material);
        quad({u.x, l.y, l.z}, {l.x, l.y, l.z}, {l.x, u.y, z}, {u.x, u.y, z}, roof_material);
        triangle({l.x, l.y, l.z}, {l.x, l.y, u.z}, {l.x, u.y, z}, gable_material);
        triangle({u.x, l.y, u.z}, {u.x, l.y, l.z}, {u.x, u.y, z}, gable_material);
    } else {
        const float x = 0.5f * (l.x + u.x);
        quad({l.x, l.y, l.z}, {l.x, l.y, u.z}, {x, u.y, u.z}, {x, u.y, l.z}, roof_material);
        quad({u.x, l.y, u.z}, {u.x, l.y, l.z}, {x, u.y, l.z}, {x, u.y, u.z}, roof_material);
        triangle({l.x, l.y, u.z}, {u.x, l.y, u.z}, {x, u.y, u.z}, gable_material);
        triangle({u.x, l.y, l.z}, {l.x, l.y, l.z}, {x, u.y, l.z}, gable_material);
    }
}

void set_bounds(Scene& scene) {
    Box bounds{scene.vertices.front().position, scene.vertices.front().position};
    for (const Vertex& vertex : scene.vertices) {
        bounds.lower = glm::min(bounds.lower, vertex.position);
        bounds.upper = glm::max(bounds.upper, vertex.position);
    }
    scene.bounds = bounds;
}

Camera look_at(const char* name, glm::vec3 from, glm::vec3 to) {
    Camera camera;
    camera.name = name;
    camera.position = from;
    const glm::vec3 toward = to - from;
    camera.forward = toward / std::sqrt(glm::dot(toward, toward));
    return camera;
}

} // namespace manylights::lab
