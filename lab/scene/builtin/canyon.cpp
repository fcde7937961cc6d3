// A canyon of 200 x 60 x 600 m in 5 m cells: winding terraced walls of 20 to 60 m, pillars in 12% of the floor cells,
// low walls, and bridges. Strong depth discontinuities at medium range.

#include "lab/scene/builtin/builtin.h"
#include "lab/scene/builtin/mesh_builder.h"
#include "lab/scene/builtin/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace manylights::lab {
namespace {

constexpr std::uint32_t kSeed = 0x0ca9704u;
constexpr int kCellsX = 40, kCellsZ = 120;
constexpr float kCell = 5.0f, kHalfX = 100.0f, kHalfZ = 300.0f, kStratum = 4.0f;
constexpr int kStrataLow = 5, kStrataHigh = 15; // 20 to 60 m

float axis_x(float z) {
    return 44.0f * (value_noise(kSeed, z / 140.0f) - 0.5f) + 14.0f * (value_noise(kSeed + 1, z / 45.0f) - 0.5f);
}
float half_width(float z) { return 19.0f + 18.0f * value_noise(kSeed + 2, z / 60.0f); }

class Canyon {
  public:
    explicit Canyon(Detail detail) : detail_(detail), mesh_(scene_) {
        make_materials();
        make_levels();
    }

    Scene build() {
        add_rock();
        add_floor();
        add_floor_objects();
        add_bridges();
        add_cameras();
        set_bounds(scene_);
        scene_.name = "canyon";
        scene_.light_box = {{-kHalfX, 0.0f, -kHalfZ}, {kHalfX, 60.0f, kHalfZ}};
        scene_.view_extent = 500.0f;
        return std::move(scene_);
    }

  private:
    static float cell_x(int i) { return -kHalfX + kCell * float(i); }
    static float cell_z(int k) { return -kHalfZ + kCell * float(k); }
    static std::uint32_t cell_index(int i, int k) { return std::uint32_t(k * kCellsX + i); }

    void make_materials() {
        const glm::vec3 bands[4] = {
            {0.46f, 0.25f, 0.15f}, {0.58f, 0.36f, 0.22f}, {0.52f, 0.30f, 0.20f}, {0.66f, 0.49f, 0.34f}};
        for (std::uint32_t i = 0; i < rock_.size(); ++i) {
            const float shade = random_between(kSeed + 3, i, 0, 0.8f, 1.1f);
            rock_[i] = mesh_.material(bands[i % 4] * shade, 0.9f);
        }
        for (std::uint32_t i = 0; i < sand_.size(); ++i)
            sand_[i] =
                mesh_.material(glm::vec3(0.55f, 0.42f, 0.29f) * random_between(kSeed + 4, i, 0, 0.85f, 1.1f), 0.95f);
        masonry_ = mesh_.material({0.45f, 0.43f, 0.40f}, 0.8f);
        timber_ = mesh_.material({0.30f, 0.19f, 0.11f}, 0.7f);
    }

    /// Height of each cell in strata; 0: floor.
    void make_levels() {
        levels_.resize(std::size_t(kCellsX * kCellsZ));
        for (int k = 0; k < kCellsZ; ++k) {
            for (int i = 0; i < kCellsX; ++i) {
                const float x = cell_x(i) + 0.5f * kCell, z = cell_z(k) + 0.5f * kCell;
                const float outside = std::fabs(x - axis_x(z)) - half_width(z);
                if (outside < 0.0f) continue;
                const float rise = outside / 50.0f + 0.9f * value_noise(kSeed + 5, x / 30.0f, z / 30.0f) - 0.15f;
                const float level = float(kStrataLow) + float(kStrataHigh - kStrataLow) * std::clamp(rise, 0.0f, 1.0f);
                levels_[cell_index(i, k)] = int(level + 0.5f);
            }
        }
    }

    int level(int i, int k) const {
        if (i < 0 || k < 0 || i >= kCellsX || k >= kCellsZ) return kStrataHigh;
        return levels_[cell_index(i, k)];
    }

    void add_rock() {
        for (int k = 0; k < kCellsZ; ++k) {
            for (int i = 0; i < kCellsX; ++i) add_column(i, k);
        }
    }

    void add_column(int i, int k) {
        const int top = level(i, k);
        const std::array<int, 4> around{level(i - 1, k), level(i + 1, k), level(i, k - 1), level(i, k + 1)};
        if (detail_ == Detail::low) {
            add_plain_column(i, k, top, around);
            return;
        }
        for (int stratum = 0; stratum < top; ++stratum) {
            unsigned exposed = 0;
            for (unsigned side = 0; side < 4; ++side) exposed |= around[side] <= stratum ? 1u << side : 0u;
            if (exposed != 0 || stratum == top - 1 || is_corner(i, k, stratum)) add_stratum(i, k, stratum, exposed);
        }
    }

    /// One rectangle per exposed side, over all of its strata.
    void add_plain_column(int i, int k, int top, const std::array<int, 4>& around) {
        if (top == 0) return;
        const std::uint32_t rock = rock_[std::size_t(top)];
        const glm::vec3 upper(cell_x(i + 1), kStratum * float(top), cell_z(k + 1));
        mesh_.box({cell_x(i), 0.0f, cell_z(k)}, upper, kSideTop, rock);
        for (unsigned side = 0; side < 4; ++side) {
            if (around[side] >= top) continue;
            mesh_.box({cell_x(i), kStratum * float(around[side]), cell_z(k)}, upper, 1u << side, rock);
        }
    }

    /// Free diagonally: seen through the gap between the two drawn-in neighbours.
    bool is_corner(int i, int k, int stratum) const {
        return std::min({level(i - 1, k - 1), level(i + 1, k - 1), level(i - 1, k + 1), level(i + 1, k + 1)}) <=
               stratum;
    }

    void add_stratum(int i, int k, int stratum, unsigned exposed) {
        const std::uint32_t index = cell_index(i, k);
        const auto channel = std::uint32_t(stratum);
        glm::vec3 lower(cell_x(i), kStratum * float(stratum), cell_z(k));
        glm::vec3 upper(lower.x + kCell, lower.y + kStratum, lower.z + kCell);
        const std::uint32_t side = rock_[channel], top = rock_[(channel + 1) % rock_.size()];
        if (exposed & kSideNegativeX) lower.x += random_between(kSeed + 6, index, channel, 0.0f, 0.8f);
        if (exposed & kSidePositiveX) upper.x -= random_between(kSeed + 7, index, channel, 0.0f, 0.8f);
        if (exposed & kSideNegativeZ) lower.z += random_between(kSeed + 8, index, channel, 0.0f, 0.8f);
        if (exposed & kSidePositiveZ) upper.z -= random_between(kSeed + 9, index, channel, 0.0f, 0.8f);
        mesh_.bevelled_box(lower, upper, random_between(kSeed + 10, index, channel, 0.2f, 0.7f), exposed, side, top);
    }

    /// Rock beside the floor: its lowest stratum is drawn in, and the floor goes on below it.
    bool is_beside_floor(int i, int k) const {
        if (detail_ == Detail::low) return false;
        return is_corner(i, k, 0) ||
               std::min({level(i - 1, k), level(i + 1, k), level(i, k - 1), level(i, k + 1)}) == 0;
    }

    void add_floor() {
        for (int k = 0; k < kCellsZ; ++k) {
            for (int i = 0; i < kCellsX; ++i) {
                if (level(i, k) != 0 && !is_beside_floor(i, k)) continue;
                const std::uint32_t sand =
                    sand_[std::size_t(random_unit(kSeed + 11, cell_index(i, k), 0) * float(sand_.size()))];
                const float x = cell_x(i), z = cell_z(k);
                mesh_.quad({x, 0, z + kCell}, {x + kCell, 0, z + kCell}, {x + kCell, 0, z}, {x, 0, z}, sand);
            }
        }
    }

    void add_floor_objects() {
        for (int k = 0; k < kCellsZ; ++k) {
            for (int i = 0; i < kCellsX; ++i) {
                if (level(i, k) != 0) continue;
                const float choice = random_unit(kSeed + 12, cell_index(i, k), 0);
                if (choice < 0.12f)
                    add_pillar(i, k);
                else if (choice < 0.18f)
                    add_low_wall(i, k);
            }
        }
    }

    void add_pillar(int i, int k) {
        const std::uint32_t index = cell_index(i, k);
        const float height = random_between(kSeed + 13, index, 0, 8.0f, 45.0f);
        const float radius = random_between(kSeed + 13, index, 1, 0.7f, 1.8f);
        const glm::vec3 base(cell_x(i) + 0.5f * kCell, 0.0f, cell_z(k) + 0.5f * kCell);
        if (detail_ == Detail::low) {
            mesh_.tower(base, radius, radius, height, 4, true, masonry_);
            return;
        }
        mesh_.tower(base, 1.35f * radius, 1.25f * radius, 1.0f, 8, true, masonry_);
        mesh_.tower(base, radius, 0.88f * radius, height - 0.8f, 8, false, masonry_);
        mesh_.tower(base + glm::vec3(0, height - 0.8f, 0), 0.88f * radius, 1.3f * radius, 0.8f, 8, true, masonry_);
    }

    void add_low_wall(int i, int k) {
        const std::uint32_t index = cell_index(i, k);
        const float height = random_between(kSeed + 14, index, 0, 1.0f, 3.0f);
        const bool along_x = random_unit(kSeed + 14, index, 1) < 0.5f;
        const glm::vec3 center(cell_x(i) + 0.5f * kCell, 0.0f, cell_z(k) + 0.5f * kCell);
        const glm::vec3 half = along_x ? glm::vec3(2.5f, height, 0.4f) : glm::vec3(0.4f, height, 2.5f);
        const glm::vec3 lower(center.x - half.x, 0.0f, center.z - half.z);
        const glm::vec3 upper(center.x + half.x, height, center.z + half.z);
        if (detail_ == Detail::low)
            mesh_.box(lower, upper, kSidesStanding, masonry_);
        else
            mesh_.bevelled_box(lower, upper, 0.12f, kSidesAround, masonry_, masonry_);
    }

    void add_bridges() {
        for (std::uint32_t n = 0; n < 7; ++n) {
            const float z = -250.0f + 80.0f * float(n) + random_between(kSeed + 15, n, 0, -15.0f, 15.0f);
            const float y = random_between(kSeed + 15, n, 1, 14.0f, 19.0f);
            const float reach = half_width(z) + 12.0f;
            const float x = axis_x(z);
            mesh_.box({x - reach, y, z - 2.0f}, {x + reach, y + 0.8f, z + 2.0f}, kSidesAll, timber_);
            for (const float side : {-2.0f, 1.8f})
                mesh_.box({x - reach, y + 0.8f, z + side}, {x + reach, y + 1.8f, z + side + 0.2f}, kSidesAll, timber_);
        }
    }

    void add_cameras() {
        const auto on_axis = [](float z, float y) { return glm::vec3(axis_x(z), y, z); };
        scene_.cameras = {look_at("axis", on_axis(290, 2.5f), on_axis(150, 8)),
                          look_at("elevated", on_axis(150, 42), on_axis(-40, 15)),
                          look_at("bend", on_axis(120, 6), on_axis(0, 10)),
                          look_at("return", on_axis(-150, 20), on_axis(30, 10))};
        for (int frame = 0; frame < 16; ++frame) {
            const float z = 285.0f - 28.0f * float(frame);
            const float y = 6.0f + 22.0f * value_noise(kSeed + 16, 0.4f * float(frame));
            scene_.path.push_back(look_at("path", on_axis(z, y), on_axis(z - 60.0f, 0.6f * y + 4.0f)));
        }
    }

    Detail detail_;
    Scene scene_;
    MeshBuilder mesh_;
    std::vector<int> levels_;
    std::array<std::uint32_t, 16> rock_{};
    std::array<std::uint32_t, 4> sand_{};
    std::uint32_t masonry_ = 0, timber_ = 0;
};

} // namespace

Scene make_canyon(Detail detail) { return Canyon(detail).build(); }

} // namespace manylights::lab
