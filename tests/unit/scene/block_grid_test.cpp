// The surface of a grid of blocks: it covers each open face once, and merges what can be merged.

#include "lab/scene/builtin/block_grid.h"
#include "lab/scene/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace manylights::lab {
namespace {

struct Made {
    Scene scene;
    double area() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < scene.indices.size(); i += 3) {
            const glm::vec3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
            sum += 0.5 * double(glm::length(glm::cross(b - a, c - a)));
        }
        return sum;
    }
    /// Volume below the surface down to y = 0, by the faces that look up and down: right only where each is there once.
    double volume() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < scene.indices.size(); i += 3) {
            const glm::vec3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
            sum += 0.5 * double(glm::cross(b - a, c - a).y) * double(a.y + b.y + c.y) / 3.0;
        }
        return sum;
    }
    std::size_t quads() const { return scene.indices.size() / 6; }

  private:
    glm::vec3 corner(std::size_t i) const { return scene.vertices[scene.indices[i]].position; }
};

Made surface_of(const BlockGrid& grid) {
    Made made;
    MeshBuilder mesh(made.scene);
    for (int i = 0; i < 4; ++i) mesh.material(glm::vec3(0.5f));
    grid.add_surface(mesh);
    return made;
}

TEST(BlockGrid, MakesABoxOfFewFaces) {
    BlockGrid grid({8, 8, 8}, {-4, 0, -4}, 1.0f);
    grid.fill({-2, 2, -1}, {3, 5, 2}, 0);
    const Made floating = surface_of(grid);
    EXPECT_EQ(floating.quads(), 6u);
    EXPECT_EQ(floating.area(), 2.0 * (5 * 3 + 5 * 3 + 3 * 3));
    EXPECT_EQ(floating.volume(), 45.0);
    grid.fill({-2, 0, -1}, {3, 2, 2}, 0);
    EXPECT_EQ(surface_of(grid).quads(), 5u) << "what stands on the ground has no lower side";
    grid.fill({-2, 2, -1}, {3, 5, 2}, 1);
    EXPECT_EQ(surface_of(grid).quads(), 9u) << "two materials, one above the other";
}

TEST(BlockGrid, HasFacesAtItsSidesAndInItsHoles) {
    BlockGrid grid({4, 4, 4}, {0, 0, 0}, 2.0f);
    grid.fill({-10, -10, -10}, {20, 20, 20}, 2);
    EXPECT_EQ(surface_of(grid).quads(), 5u);
    EXPECT_EQ(surface_of(grid).area(), 5 * 64.0);
    grid.fill({2, 2, 2}, {4, 4, 4}, BlockGrid::kEmpty);
    EXPECT_EQ(surface_of(grid).quads(), 11u);
    EXPECT_EQ(surface_of(grid).area(), 5 * 64.0 + 6 * 4.0);
}

TEST(BlockGrid, FillsTheBlocksWhoseCentresAreInside) {
    BlockGrid grid({4, 4, 4}, {0, 0, 0}, 8.0f);
    grid.fill({5, 0, 3}, {20, 4, 12}, 1); // y: no centre
    EXPECT_EQ(surface_of(grid).quads(), 0u);
    grid.fill({5, 0, 3}, {20, 5, 12}, 1);
    EXPECT_EQ(grid.at(1, 0, 0), 1);
    EXPECT_EQ(grid.at(0, 0, 0), BlockGrid::kEmpty);
    EXPECT_EQ(grid.at(2, 0, 0), BlockGrid::kEmpty) << "ends at its centre";
    EXPECT_EQ(grid.at(1, 0, 1), BlockGrid::kEmpty) << "ends at its centre";
}

// In disorder: as much area as there are open faces, and the volume of the blocks.
TEST(BlockGrid, CoversEachOpenFaceOnce) {
    constexpr int kEdge = 12;
    BlockGrid grid({kEdge, kEdge, kEdge}, {0, 0, 0}, 1.0f);
    int blocks = 0, faces = 0;
    for (int i = 0; i < kEdge * kEdge * kEdge; ++i) {
        if (random_unit(5, std::uint32_t(i), 0) < 0.4f) continue;
        const glm::vec3 lower(i % kEdge, i / kEdge % kEdge, i / (kEdge * kEdge));
        grid.fill(lower, lower + 1.0f, std::uint8_t(hash_counter(5, std::uint32_t(i), 1) % 4));
        ++blocks;
    }
    const auto is_solid = [&](glm::ivec3 b) {
        for (int axis = 0; axis < 3; ++axis)
            if (b[axis] < 0 || b[axis] >= kEdge) return false;
        return grid.at(b.x, b.y, b.z) != BlockGrid::kEmpty;
    };
    for (int i = 0; i < kEdge * kEdge * kEdge; ++i) {
        const glm::ivec3 block(i % kEdge, i / kEdge % kEdge, i / (kEdge * kEdge));
        if (!is_solid(block)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            for (const int side : {-1, 1}) {
                glm::ivec3 next = block;
                next[axis] += side;
                faces += !is_solid(next) && next.y >= 0 ? 1 : 0;
            }
        }
    }
    const Made made = surface_of(grid);
    EXPECT_NEAR(made.area(), faces, 1e-3);
    EXPECT_NEAR(made.volume(), blocks, 1e-2);
    EXPECT_LT(made.quads(), std::size_t(faces));
}

} // namespace
} // namespace manylights::lab
