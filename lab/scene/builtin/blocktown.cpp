// A town of unit blocks on an island, 768 x 128 x 640: a street grid of 32, houses with gabled roofs in steps, a ring
// wall with towers, a castle on a hill, a river with bridges, and water around. Low detail has blocks of 8.

#include "lab/scene/builtin/block_grid.h"
#include "lab/scene/builtin/builtin.h"
#include "lab/scene/builtin/noise.h"

#include <algorithm>
#include <cmath>

namespace manylights::lab {
namespace {

constexpr std::uint32_t kSeed = 0xb10cu;
constexpr int kPitch = 32, kStreet = 8; // a street begins at each multiple of the pitch
constexpr float kHalfX = 384.0f, kHalfZ = 320.0f, kHeight = 128.0f;
constexpr float kWater = 8.0f, kCastleGround = 36.0f, kCastleHalf = 64.0f;
constexpr float kWallX = 256.0f, kWallZ = 192.0f; // half extents of the ring wall

enum Block : std::uint8_t { kGrass, kSand, kRock, kPaving, kStone, kWaterTop, kTimber, kGlass, kLeaves, kPlaster };
constexpr std::uint8_t kPlasters = 5, kRoof = kPlaster + kPlasters, kRoofs = 4;

float river_center(float z) { return -144.0f + 60.0f * (value_noise(kSeed, z / 110.0f) - 0.5f); }
bool is_river(float x, float z) { return std::fabs(x - river_center(z)) < 10.0f; }
bool is_castle(float x, float z) { return std::fabs(x) < kCastleHalf && std::fabs(z) < kCastleHalf; }

/// Where the ground ends, in whole blocks: an island with a hill for the castle, cut by the river.
float ground(float x, float z) {
    if (is_river(x, z)) return 4.0f;
    const float from_x = x / kHalfX, from_z = z / kHalfZ, away = std::sqrt(from_x * from_x + from_z * from_z);
    const float shore = std::clamp((1.02f - away) / 0.12f, 0.0f, 1.0f);
    const float hill = std::clamp((0.52f - away) / 0.34f, 0.0f, 1.0f);
    const float height = 4.0f + 8.5f * shore + 24.0f * smooth_step(hill) +
                         4.0f * shore * (1.0f - hill) * value_noise(kSeed + 1, x / 70.0f, z / 70.0f);
    return float(int(height));
}

class Blocktown {
  public:
    explicit Blocktown(Detail detail)
        : detail_(detail), mesh_(scene_),
          grid_(glm::ivec3(768, 128, 640) / edge(), {-kHalfX, 0.0f, -kHalfZ}, float(edge())) {
        const glm::vec3 colors[] = {{0.24f, 0.36f, 0.12f}, {0.62f, 0.54f, 0.36f}, {0.36f, 0.33f, 0.30f},
                                    {0.34f, 0.32f, 0.30f}, {0.50f, 0.49f, 0.46f}, {0.08f, 0.20f, 0.30f},
                                    {0.26f, 0.15f, 0.08f}, {0.16f, 0.20f, 0.26f}, {0.12f, 0.28f, 0.08f},
                                    {0.78f, 0.72f, 0.60f}, {0.70f, 0.58f, 0.42f}, {0.66f, 0.48f, 0.36f},
                                    {0.80f, 0.78f, 0.72f}, {0.58f, 0.60f, 0.58f}, {0.46f, 0.16f, 0.10f},
                                    {0.56f, 0.26f, 0.14f}, {0.30f, 0.14f, 0.12f}, {0.24f, 0.28f, 0.34f}};
        for (std::size_t i = 0; i < std::size(colors); ++i)
            mesh_.material(colors[i], i == kWaterTop ? 0.15f : i == kGlass ? 0.2f : 0.85f);
    }

    Scene build() {
        add_terrain();
        add_plots();
        add_ring_wall();
        add_bridges();
        add_castle();
        grid_.add_surface(mesh_);
        add_cameras();
        set_bounds(scene_);
        scene_.name = "blocktown";
        scene_.light_box = {{-kHalfX, 0.0f, -kHalfZ}, {kHalfX, kHeight, kHalfZ}};
        scene_.distribution = "groups";
        scene_.view_extent = 1000.0f;
        scene_.radii = {2.0f, 6.0f, 2.0f, 6.0f, 0.0f, 1.0f};
        return std::move(scene_);
    }

  private:
    int edge() const { return detail_ == Detail::low ? 8 : 1; }

    void add_terrain() {
        const auto step = float(edge());
        for (float z = -kHalfZ; z < kHalfZ; z += step) {
            for (float x = -kHalfX; x < kHalfX; x += step) add_column(x, z, step);
        }
    }

    // Streets are where the town is, and the castle's hill is of grass.
    void add_column(float x, float z, float step) {
        const float height = ground(x + 0.5f * step, z + 0.5f * step);
        const bool is_street = (int(x + kHalfX) % kPitch < kStreet || int(z + kHalfZ) % kPitch < kStreet) &&
                               is_town(x, z) && !is_castle(x, z);
        const glm::vec3 lower(x, 0.0f, z), size(step, 0.0f, step);
        grid_.fill(lower, lower + size + glm::vec3(0, height, 0), kRock);
        const Block top = is_street ? kPaving : height < kWater + 2.0f ? kSand : kGrass;
        grid_.fill(lower + glm::vec3(0, height - step, 0), lower + size + glm::vec3(0, height, 0), top);
        if (height < kWater)
            grid_.fill(lower + glm::vec3(0, height, 0), lower + size + glm::vec3(0, kWater, 0), kWaterTop);
    }

    static bool is_town(float x, float z) { return std::fabs(x) < kWallX && std::fabs(z) < kWallZ && !is_river(x, z); }

    // A plot is 24 x 24 between streets; it has one house, or two, or four, or trees.
    void add_plots() {
        for (int k = 0; k < int(2.0f * kHalfZ) / kPitch; ++k) {
            for (int i = 0; i < int(2.0f * kHalfX) / kPitch; ++i) {
                const float x = float(i * kPitch + kStreet) - kHalfX, z = float(k * kPitch + kStreet) - kHalfZ;
                const auto index = std::uint32_t(k * 32 + i);
                if (is_castle(x + 12.0f, z + 12.0f) || ground(x + 12.0f, z + 12.0f) < kWater + 3.0f) continue;
                const float choice = random_unit(kSeed + 2, index, 0);
                if (is_town(x, z) && is_town(x + 23.0f, z + 23.0f) && choice < 0.9f)
                    add_houses(x, z, index, choice);
                else
                    add_trees(x, z, index);
            }
        }
    }

    void add_houses(float x, float z, std::uint32_t index, float choice) {
        const int across = choice < 0.55f ? 2 : 1, down = choice < 0.35f || choice > 0.75f ? 2 : 1;
        const float width = 24.0f / float(across), depth = 24.0f / float(down);
        for (int b = 0; b < down; ++b) {
            for (int a = 0; a < across; ++a) {
                const std::uint32_t house = index * 4 + std::uint32_t(2 * b + a);
                const float gap = float(1 + hash_counter(kSeed + 3, house, 0) % 2);
                const glm::vec3 lower(x + width * float(a) + gap, 0.0f, z + depth * float(b) + gap);
                add_house(lower, lower + glm::vec3(width - 2.0f * gap, 0.0f, depth - 2.0f * gap), house);
            }
        }
    }

    /// lower and upper: the outline, at whole blocks. The foundation reaches down into the ground.
    void add_house(glm::vec3 lower, glm::vec3 upper, std::uint32_t house) {
        const float base = std::max(
            {ground(lower.x, lower.z), ground(upper.x, lower.z), ground(lower.x, upper.z), ground(upper.x, upper.z)});
        const auto storeys = float(1 + hash_counter(kSeed + 4, house, 0) % 3);
        const auto wall = std::uint8_t(kPlaster + hash_counter(kSeed + 4, house, 1) % kPlasters);
        const auto roof = std::uint8_t(kRoof + hash_counter(kSeed + 4, house, 2) % kRoofs);
        lower.y = base, upper.y = base + 5.0f * storeys + 1.0f;
        grid_.fill({lower.x, base - 8.0f, lower.z}, {upper.x, base + 1.0f, upper.z}, kStone);
        grid_.fill(lower + glm::vec3(0, 1, 0), upper, wall);
        if (detail_ == Detail::full) add_facade(lower, upper, storeys);
        add_roof(lower, upper, roof, wall);
    }

    // Beams at the corners and between the storeys, windows in every third block.
    void add_facade(glm::vec3 lower, glm::vec3 upper, float storeys) {
        for (const float x : {lower.x, upper.x - 1.0f}) {
            for (const float z : {lower.z, upper.z - 1.0f})
                grid_.fill({x, lower.y + 1.0f, z}, {x + 1.0f, upper.y, z + 1.0f}, kTimber);
        }
        for (float storey = 0.0f; storey < storeys; storey += 1.0f) {
            const float sill = lower.y + 5.0f * storey + 2.0f, beam = sill + 3.0f;
            for (float x = lower.x + 2.0f; x < upper.x - 2.0f; x += 3.0f)
                grid_.fill({x, sill, lower.z}, {x + 1.0f, sill + 2.0f, upper.z}, kGlass);
            for (float z = lower.z + 2.0f; z < upper.z - 2.0f; z += 3.0f)
                grid_.fill({lower.x, sill, z}, {upper.x, sill + 2.0f, z + 1.0f}, kGlass);
            grid_.fill({lower.x, beam, lower.z}, {upper.x, beam + 1.0f, upper.z}, kTimber);
        }
    }

    // Steps of one block from the long sides to the ridge; the gables are walls.
    void add_roof(glm::vec3 lower, glm::vec3 upper, std::uint8_t roof, std::uint8_t wall) {
        const bool along_x = upper.x - lower.x > upper.z - lower.z;
        const int across = along_x ? 2 : 0, along = along_x ? 0 : 2;
        for (float y = 0.0f; lower[across] + y - 1.0f < upper[across] - y + 1.0f; y += 1.0f) {
            glm::vec3 l(0.0f), u(0.0f);
            l.y = upper.y + y, u.y = l.y + 1.0f;
            l[across] = lower[across] + y - 1.0f, u[across] = upper[across] - y + 1.0f;
            l[along] = lower[along], u[along] = upper[along];
            grid_.fill(l, u, roof);
            l[across] += 2.0f, u[across] -= 2.0f;
            grid_.fill(l, u, wall);
            l[along] += 1.0f, u[along] -= 1.0f;
            grid_.fill(l, u, roof);
        }
    }

    void add_trees(float x, float z, std::uint32_t index) {
        const auto trees = std::uint32_t(4.0f * random_unit(kSeed + 5, index, 0));
        for (std::uint32_t tree = 0; tree < trees; ++tree) {
            const float tx = x + std::floor(random_between(kSeed + 5, index, 4 * tree + 1, 3.0f, 20.0f));
            const float tz = z + std::floor(random_between(kSeed + 5, index, 4 * tree + 2, 3.0f, 20.0f));
            const float base = ground(tx, tz);
            const float trunk = std::floor(random_between(kSeed + 5, index, 4 * tree + 3, 3.0f, 7.0f));
            if (base < kWater + 2.0f) continue;
            grid_.fill({tx, base, tz}, {tx + 1.0f, base + trunk, tz + 1.0f}, kTimber);
            grid_.fill({tx - 2, base + trunk, tz - 2}, {tx + 3, base + trunk + 3, tz + 3}, kLeaves);
            grid_.fill({tx - 1, base + trunk + 3, tz - 1}, {tx + 2, base + trunk + 5, tz + 2}, kLeaves);
        }
    }

    // Between two corners of an outline, with battlements of two blocks.
    void add_wall(float x0, float z0, float x1, float z1, float bottom, float top) {
        grid_.fill({x0, bottom, z0}, {x1, top, z1}, kStone);
        if (detail_ == Detail::low) return;
        for (float x = x0; x < x1; x += 4.0f) {
            for (const float z : {z0, z1 - 1.0f}) grid_.fill({x, top, z}, {x + 2.0f, top + 2.0f, z + 1.0f}, kStone);
        }
        for (float z = z0; z < z1; z += 4.0f) {
            for (const float x : {x0, x1 - 1.0f}) grid_.fill({x, top, z}, {x + 1.0f, top + 2.0f, z + 2.0f}, kStone);
        }
    }

    void add_tower(float x, float z, float half, float bottom, float top) {
        add_wall(x - half, z - half, x + half, z + half, bottom, top);
        for (float y = 0.0f; y < half; y += 1.0f) {
            const float reach = half - y;
            grid_.fill({x - reach, top + 2.0f + 2.0f * y, z - reach}, {x + reach, top + 4.0f + 2.0f * y, z + reach},
                       kRoof + 3);
        }
    }

    // Gates are where the streets in the middle leave, and the river flows through.
    void add_ring_wall() {
        for (const float side : {-1.0f, 1.0f}) {
            const float z = side * kWallZ - 2.0f, x = side * kWallX - 2.0f;
            for (float from = -kWallX; from < kWallX; from += 8.0f) {
                if (from != 0.0f && !is_river(from + 4.0f, z)) add_wall(from, z, from + 8.0f, z + 4.0f, 4.0f, 30.0f);
            }
            for (float from = -kWallZ; from < kWallZ; from += 8.0f) {
                if (from != 0.0f) add_wall(x, from, x + 4.0f, from + 8.0f, 4.0f, 30.0f);
            }
            for (float at = -kWallX; at <= kWallX; at += 128.0f)
                add_tower(at == 0.0f ? 16.0f : at, z, 6.0f, 4.0f, 38.0f);
            for (float at = -kWallZ; at <= kWallZ; at += 128.0f) add_tower(x, at, 6.0f, 4.0f, 38.0f);
        }
    }

    void add_bridges() {
        for (float z = -160.0f; z < kWallZ; z += 64.0f) {
            const float x = river_center(z + 4.0f);
            grid_.fill({x - 18.0f, 14.0f, z}, {x + 18.0f, 16.0f, z + 8.0f}, kStone);
            for (const float pier : {-18.0f, -2.0f, 14.0f})
                grid_.fill({x + pier, 2.0f, z}, {x + pier + 4.0f, 14.0f, z + 8.0f}, kStone);
        }
    }

    void add_castle() {
        const float g = kCastleGround, bottom = g - 16.0f;
        for (const float side : {-44.0f, 40.0f}) {
            add_wall(-44.0f, side, 44.0f, side + 4.0f, bottom, g + 14.0f);
            add_wall(side, -44.0f, side + 4.0f, 44.0f, bottom, g + 14.0f);
        }
        grid_.fill({-4.0f, g, 40.0f}, {4.0f, g + 9.0f, 44.0f}, BlockGrid::kEmpty);
        for (const float x : {-42.0f, 42.0f}) {
            for (const float z : {-42.0f, 42.0f}) add_tower(x, z, 8.0f, bottom, g + 28.0f);
        }
        add_wall(-16.0f, -24.0f, 16.0f, 8.0f, bottom, g + 40.0f);
        add_tower(-10.0f, -18.0f, 8.0f, bottom, g + 70.0f);
        add_tower(12.0f, 4.0f, 6.0f, bottom, g + 54.0f);
        const glm::vec3 hall(-36.0f, g, 14.0f);
        add_house(hall, hall + glm::vec3(24.0f, 0.0f, 18.0f), 0);
    }

    /// At the middle of the street of cells (i, k), above the ground.
    static glm::vec3 in_street(float x, float z, float above) { return {x, ground(x, z) + above, z}; }

    // Far away at the beginning, in the middle and at the end, at street level between.
    void add_cameras() {
        scene_.cameras = {look_at("far", {-300, 125, 390}, {0, -30, 30}),
                          look_at("street", in_street(100, 170, 6), in_street(100, -100, 8)),
                          look_at("roofs", {190, 62, 150}, {-60, 24, -60}),
                          look_at("river", {river_center(300), 16, 300}, {river_center(0), 24, 0})};
        for (int frame = 0; frame < 16; ++frame) scene_.path.push_back(path_frame(frame));
    }

    static Camera path_frame(int frame) {
        const glm::vec3 center(0.0f, -45.0f, 0.0f);
        if (frame < 2) return look_at("path", {-320.0f + 80.0f * float(frame), 125.0f, 380.0f}, center);
        if (frame == 7 || frame == 8)
            return look_at("path", {400.0f, 110.0f, -240.0f + 120.0f * float(frame - 7)}, center);
        if (frame > 13) return look_at("path", {60.0f, 120.0f, -380.0f - 60.0f * float(frame - 14)}, center);
        if (frame < 7) {
            const float x = -220.0f + 40.0f * float(frame - 2);
            return look_at("path", in_street(x, 132.0f, 6), in_street(x + 120.0f, 132.0f, 10));
        }
        const float z = 150.0f - 60.0f * float(frame - 9);
        return look_at("path", in_street(132.0f, z, 6), in_street(132.0f, z - 120.0f, 10));
    }

    Detail detail_;
    Scene scene_;
    MeshBuilder mesh_;
    BlockGrid grid_;
};

} // namespace

Scene make_blocktown(Detail detail) { return Blocktown(detail).build(); }

} // namespace manylights::lab
