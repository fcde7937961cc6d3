// A town of 3 x 3 km in 20 m cells: a street grid of 100 m, a terraced hill, houses of 6 to 24 m with tiled roofs, and
// towers up to 180 m. Very long views.

#include "lab/scene/builtin/builtin.h"
#include "lab/scene/builtin/mesh_builder.h"
#include "lab/scene/builtin/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace manylights::lab {
namespace {

constexpr std::uint32_t kSeed = 0xc17adeu;
constexpr int kCells = 150, kBlock = 5; // every fifth row and column of cells is a street
constexpr float kCell = 20.0f, kHalf = 1500.0f;

float cell_edge(int i) { return -kHalf + kCell * float(i); }

/// Ground height of a cell: a hill of 8 m terraces around the centre, one height per block and its streets.
float ground(int i, int k) {
    const float x = cell_edge(i / kBlock * kBlock) + 50.0f, z = cell_edge(k / kBlock * kBlock) + 50.0f;
    const float d = std::sqrt(x * x + z * z) / 800.0f;
    const float hill = 110.0f * std::max(0.0f, 1.0f - d) * std::max(0.0f, 1.0f - d) +
                       12.0f * value_noise(kSeed, x / 500.0f, z / 500.0f);
    return 8.0f * float(int(hill / 8.0f));
}

class Citadel {
  public:
    explicit Citadel(Detail detail) : detail_(detail), mesh_(scene_) {
        for (std::uint32_t i = 0; i < plaster_.size(); ++i) {
            const float shade = random_between(kSeed + 1, i, 0, 0.75f, 1.05f), warmth = random_unit(kSeed + 1, i, 1);
            const glm::vec3 tint = shade * glm::vec3(0.72f, 0.66f - 0.14f * warmth, 0.56f - 0.26f * warmth);
            plaster_[i] = add_material(tint, 0.9f, {1.0f, 0.3f, 2.5f});
        }
        for (std::uint32_t i = 0; i < roof_.size(); ++i) {
            const float shade = random_between(kSeed + 2, i, 0, 0.75f, 1.15f);
            roof_[i] = add_material(glm::vec3(0.48f, 0.20f, 0.12f) * shade, 0.75f, {1.0f, 0.3f, 2.5f});
        }
        stone_ = add_material({0.50f, 0.48f, 0.44f}, 0.85f, {1.0f, 0.3f, 2.5f});
        street_ = add_material({0.32f, 0.30f, 0.28f}, 0.8f, {1.0f, 2.0f, 6.0f});
        ground_ = add_material({0.36f, 0.38f, 0.22f}, 0.95f, {0.2f, 0.3f, 2.5f});
    }

    Scene build() {
        add_terrain();
        add_buildings();
        add_cameras();
        set_bounds(scene_);
        scene_.name = "citadel";
        scene_.light_box = {{-kHalf, 0.0f, -kHalf}, {kHalf, 180.0f, kHalf}};
        scene_.view_extent = 3500.0f;
        scene_.radii.large_share = 0.01f;
        scene_.radii.scale_cap = 2.0f;
        scene_.crowding_radius = 1500.0f;
        return std::move(scene_);
    }

  private:
    std::uint32_t add_material(glm::vec3 color, float roughness, SurfaceRule rule) {
        scene_.surface_rules.push_back(rule);
        return mesh_.material(color, roughness);
    }

    static bool is_street(int i) { return i % kBlock == 0; }

    void add_terrain() {
        const int step = detail_ == Detail::low ? kBlock : 1;
        for (int k = 0; k < kCells; k += step) {
            for (int i = 0; i < kCells; i += step) add_ground(i, k, step);
        }
    }

    void add_ground(int i, int k, int step) {
        const float x0 = cell_edge(i), z0 = cell_edge(k), x1 = cell_edge(i + step), z1 = cell_edge(k + step);
        const float y = ground(i, k);
        const bool street = is_street(i) || is_street(k);
        mesh_.quad({x0, y, z1}, {x1, y, z1}, {x1, y, z0}, {x0, y, z0}, street ? street_ : ground_);
        const float left = i > 0 ? ground(i - 1, k) : y, back = k > 0 ? ground(i, k - 1) : y;
        if (left < y) mesh_.quad({x0, left, z0}, {x0, left, z1}, {x0, y, z1}, {x0, y, z0}, stone_);
        if (left > y) mesh_.quad({x0, y, z1}, {x0, y, z0}, {x0, left, z0}, {x0, left, z1}, stone_);
        if (back < y) mesh_.quad({x1, back, z0}, {x0, back, z0}, {x0, y, z0}, {x1, y, z0}, stone_);
        if (back > y) mesh_.quad({x0, y, z0}, {x1, y, z0}, {x1, back, z0}, {x0, back, z0}, stone_);
    }

    void add_buildings() {
        const int step = detail_ == Detail::low ? 2 : 1;
        for (int k = 1; k < kCells; k += step) {
            for (int i = 1; i < kCells; i += step) {
                if (is_street(i) || is_street(k) || (step == 2 && (is_street(i + 1) || is_street(k + 1)))) continue;
                add_building(i, k, step);
            }
        }
    }

    void add_building(int i, int k, int cells) {
        const auto index = std::uint32_t(k * kCells + i);
        const float choice = random_unit(kSeed + 3, index, 0);
        const float x = cell_edge(i) + 0.5f * kCell * float(cells), z = cell_edge(k) + 0.5f * kCell * float(cells);
        const float y = ground(i, k);
        if (choice < 0.012f * float(cells * cells))
            add_tower({x, y, z}, index);
        else if (choice < 0.68f)
            add_house({x, y, z}, index, kCell * float(cells));
    }

    void add_house(glm::vec3 base, std::uint32_t index, float cell) {
        const float height = random_between(kSeed + 4, index, 0, 6.0f, 24.0f);
        const float half_x = 0.5f * cell * random_between(kSeed + 4, index, 1, 0.6f, 0.95f);
        const float half_z = 0.5f * cell * random_between(kSeed + 4, index, 2, 0.6f, 0.95f);
        const std::uint32_t wall = plaster_[hash_counter(kSeed + 4, index, 3) % plaster_.size()];
        const std::uint32_t roof = roof_[hash_counter(kSeed + 4, index, 4) % roof_.size()];
        const glm::vec3 lower(base.x - half_x, base.y, base.z - half_z);
        const glm::vec3 upper(base.x + half_x, base.y + height, base.z + half_z);
        if (detail_ == Detail::low) {
            mesh_.box(lower, upper, kSidesStanding, wall, roof);
            return;
        }
        mesh_.box(lower, upper, kSidesAround, wall);
        const glm::vec3 eaves(0.5f, 0.0f, 0.5f);
        const float ridge = 0.45f * std::min(half_x, half_z) + 1.0f;
        mesh_.gabled_roof(glm::vec3(lower.x, upper.y, lower.z) - eaves, upper + eaves + glm::vec3(0, ridge, 0),
                          half_x > half_z, roof, wall);
    }

    void add_tower(glm::vec3 base, std::uint32_t index) {
        const float away = std::sqrt(base.x * base.x + base.z * base.z) / kHalf;
        const float tallest = std::max(50.0f, 180.0f - base.y - 100.0f * away);
        const float height = random_between(kSeed + 5, index, 0, 30.0f, tallest - 20.0f);
        const float radius = random_between(kSeed + 5, index, 1, 4.0f, 8.0f);
        const unsigned corners = detail_ == Detail::low ? 4 : 12;
        const std::uint32_t roof = roof_[hash_counter(kSeed + 5, index, 2) % roof_.size()];
        const glm::vec3 top = base + glm::vec3(0, height, 0);
        mesh_.tower(base, radius, 0.92f * radius, height, corners, true, stone_);
        mesh_.tower(top, 1.15f * radius, 0.0f, 18.0f, corners, false, roof);
    }

    void add_cameras() {
        scene_.cameras = {
            look_at("gate", {10, 40, 1450}, {10, 50, 0}), look_at("rooftops", {10, 25, 1100}, {10, 60, -400}),
            look_at("terrace", {-890, 60, 910}, {0, 40, -100}), look_at("street", {-1190, 12, 910}, {-1190, 20, -500})};
        for (int frame = 0; frame < 16; ++frame) {
            const float t = float(frame) / 15.0f;
            scene_.path.push_back(look_at("path", {10.0f, 40.0f + 600.0f * t * (1.0f - t), 1450.0f - 2200.0f * t},
                                          {200.0f - 400.0f * t, 30.0f, 400.0f - 2200.0f * t}));
        }
    }

    Detail detail_;
    Scene scene_;
    MeshBuilder mesh_;
    std::array<std::uint32_t, 8> plaster_{};
    std::array<std::uint32_t, 6> roof_{};
    std::uint32_t stone_ = 0, street_ = 0, ground_ = 0;
};

} // namespace

Scene make_citadel(Detail detail) { return Citadel(detail).build(); }

} // namespace manylights::lab
