// Cornell box, 10 x 10 x 10: five walls and two boxes.

#include "lab/scene/builtin/builtin.h"
#include "lab/scene/builtin/mesh_builder.h"

namespace manylights::lab {
namespace {

/// A box turned about the vertical axis by the angle with cosine c and sine s.
void turned_box(MeshBuilder& mesh, glm::vec3 center, glm::vec3 half, float c, float s, std::uint32_t material) {
    const auto at = [&](float x, float y, float z) {
        return center + glm::vec3(c * x * half.x + s * z * half.z, y * half.y, c * z * half.z - s * x * half.x);
    };
    mesh.quad(at(-1, -1, 1), at(1, -1, 1), at(1, 1, 1), at(-1, 1, 1), material);
    mesh.quad(at(1, -1, -1), at(-1, -1, -1), at(-1, 1, -1), at(1, 1, -1), material);
    mesh.quad(at(-1, -1, -1), at(-1, -1, 1), at(-1, 1, 1), at(-1, 1, -1), material);
    mesh.quad(at(1, -1, 1), at(1, -1, -1), at(1, 1, -1), at(1, 1, 1), material);
    mesh.quad(at(-1, 1, 1), at(1, 1, 1), at(1, 1, -1), at(-1, 1, -1), material);
}

} // namespace

Scene make_cornell(Detail) {
    Scene scene;
    scene.name = "cornell";
    MeshBuilder mesh(scene);
    const std::uint32_t white = mesh.material({0.73f, 0.72f, 0.68f}, 0.9f);
    const std::uint32_t red = mesh.material({0.63f, 0.065f, 0.05f}, 0.9f);
    const std::uint32_t green = mesh.material({0.14f, 0.45f, 0.091f}, 0.9f);
    const float h = 5.0f;
    mesh.quad({-h, 0, h}, {h, 0, h}, {h, 0, -h}, {-h, 0, -h}, white);
    mesh.quad({-h, 10, -h}, {h, 10, -h}, {h, 10, h}, {-h, 10, h}, white);
    mesh.quad({-h, 0, -h}, {h, 0, -h}, {h, 10, -h}, {-h, 10, -h}, white);
    mesh.quad({-h, 0, h}, {-h, 0, -h}, {-h, 10, -h}, {-h, 10, h}, red);
    mesh.quad({h, 0, -h}, {h, 0, h}, {h, 10, h}, {h, 10, -h}, green);
    turned_box(mesh, {-1.7f, 3.0f, -1.8f}, {1.5f, 3.0f, 1.5f}, 0.956f, 0.292f, white);
    turned_box(mesh, {1.8f, 1.5f, 1.2f}, {1.5f, 1.5f, 1.5f}, 0.951f, -0.309f, white);
    set_bounds(scene);
    scene.light_box = scene.bounds;
    scene.view_extent = 30.0f;
    scene.radii = {0.4f, 1.6f, 3.0f, 8.0f, 0.0005f, 1.0f};
    scene.cameras = {look_at("front", {0.0f, 5.0f, 13.2f}, {0.0f, 5.0f, 0.0f}),
                     look_at("low", {3.9f, 1.2f, 4.7f}, {-1.5f, 3.0f, -2.5f}),
                     look_at("high", {-4.2f, 8.8f, 4.6f}, {1.2f, 1.5f, -1.5f}),
                     look_at("between", {4.2f, 4.5f, -4.2f}, {-1.5f, 2.0f, 3.0f})};
    for (int frame = 0; frame < 16; ++frame) {
        const float t = float(frame) / 15.0f;
        const glm::vec3 from(-4.0f + 8.0f * t, 2.0f + 24.0f * t * (1.0f - t), 9.5f - 5.5f * t);
        scene.path.push_back(look_at("path", from, {0.0f, 4.0f, -2.0f}));
    }
    return scene;
}

} // namespace manylights::lab
