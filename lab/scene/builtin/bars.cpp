// Thin tall bars in front of a wall: 22% of the 4 m cells of a 400 x 400 m field hold a bar 0.25 to 0.75 m thick and
// 120 m high, the wall stands at 400 m. Depth discontinuities everywhere.

#include "lab/scene/builtin/builtin.h"
#include "lab/scene/builtin/mesh_builder.h"
#include "lab/scene/builtin/noise.h"

#include <array>

namespace manylights::lab {
namespace {

constexpr std::uint32_t kSeed = 0xba45u;
constexpr int kCells = 100;
constexpr float kCell = 4.0f, kHalf = 200.0f, kBarHeight = 120.0f;

void add_bars(MeshBuilder& mesh, Detail detail) {
    std::array<std::uint32_t, 6> paint{};
    const glm::vec3 colors[6] = {{0.75f, 0.72f, 0.66f}, {0.62f, 0.30f, 0.22f}, {0.30f, 0.42f, 0.50f},
                                 {0.80f, 0.62f, 0.30f}, {0.36f, 0.44f, 0.30f}, {0.50f, 0.50f, 0.54f}};
    for (std::size_t i = 0; i < paint.size(); ++i) paint[i] = mesh.material(colors[i], 0.55f);
    for (int k = 0; k < kCells; ++k) {
        for (int i = 0; i < kCells; ++i) {
            const auto index = std::uint32_t(k * kCells + i);
            if (random_unit(kSeed, index, 0) >= 0.22f) continue;
            const float half = 0.5f * random_between(kSeed, index, 1, 0.25f, 0.75f);
            const float x = -kHalf + kCell * (float(i) + random_between(kSeed, index, 2, 0.1f, 0.9f));
            const float z = -kHalf + kCell * (float(k) + random_between(kSeed, index, 3, 0.1f, 0.9f));
            const std::uint32_t color = paint[std::size_t(6.0f * random_unit(kSeed, index, 4))];
            if (detail == Detail::low) {
                mesh.box({x - half, 0, z - half}, {x + half, kBarHeight, z + half}, kSidesAround, color);
                continue;
            }
            mesh.box({x - half, 0, z - half}, {x + half, kBarHeight, z + half}, kSidesStanding, color);
            mesh.bevelled_box({x - 1.6f * half, 0, z - 1.6f * half}, {x + 1.6f * half, 1.2f, z + 1.6f * half}, 0.1f,
                              kSidesAround, color, color);
        }
    }
}

void add_floor_and_wall(MeshBuilder& mesh) {
    const std::uint32_t tiles[2] = {mesh.material({0.52f, 0.50f, 0.47f}, 0.6f),
                                    mesh.material({0.34f, 0.33f, 0.32f}, 0.6f)};
    const std::uint32_t bricks[2] = {mesh.material({0.60f, 0.55f, 0.48f}, 0.9f),
                                     mesh.material({0.50f, 0.44f, 0.38f}, 0.9f)};
    for (int k = 0; k < 20; ++k) {
        for (int i = 0; i < 20; ++i) {
            const float x = -kHalf + 20.0f * float(i), z = -kHalf + 20.0f * float(k);
            mesh.quad({x, 0, z + 20}, {x + 20, 0, z + 20}, {x + 20, 0, z}, {x, 0, z}, tiles[(i + k) % 2]);
        }
        for (int j = 0; j < 12; ++j) {
            const float x = -kHalf + 20.0f * float(k), y = 10.0f * float(j);
            mesh.quad({x, y, -kHalf}, {x + 20, y, -kHalf}, {x + 20, y + 10, -kHalf}, {x, y + 10, -kHalf},
                      bricks[(j + k) % 2]);
        }
    }
}

} // namespace

Scene make_bars(Detail detail) {
    Scene scene;
    scene.name = "bars";
    MeshBuilder mesh(scene);
    add_floor_and_wall(mesh);
    add_bars(mesh, detail);
    set_bounds(scene);
    scene.light_box = {{-kHalf, 0.0f, -kHalf}, {kHalf, 80.0f, kHalf}};
    scene.view_extent = 500.0f;
    scene.cameras = {look_at("front", {0, 20, 200}, {0, 30, -200}), look_at("corner", {-170, 12, 185}, {60, 25, -150}),
                     look_at("high", {40, 45, 160}, {-20, 25, -140}),
                     look_at("inside", {100, 6, 120}, {-100, 20, -180})};
    for (int frame = 0; frame < 16; ++frame) {
        const float t = float(frame) / 15.0f;
        scene.path.push_back(look_at("path",
                                     {-150.0f + 250.0f * t, 6.0f + 120.0f * t * (1.0f - t), 205.0f - 120.0f * t},
                                     {120.0f - 240.0f * t, 25.0f, -200.0f}));
    }
    return scene;
}

} // namespace manylights::lab
