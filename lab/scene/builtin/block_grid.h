#pragma once
// A world of cubic blocks, each of one material or empty, and its surface in few triangles: faces between a block and
// nothing, neighbours of one material merged into rectangles.

#include "lab/scene/builtin/mesh_builder.h"

#include <cstdint>
#include <vector>

namespace manylights::lab {

class BlockGrid {
  public:
    static constexpr std::uint8_t kEmpty = 0xFF;

    /// Of so many blocks, empty; lower: the corner of the first one, in the world.
    BlockGrid(glm::ivec3 size, glm::vec3 lower, float edge);

    /// Fills the blocks whose centres lie in the box; what is outside of the grid is left out. Coordinates are of the
    /// world. kEmpty clears them.
    void fill(glm::vec3 lower, glm::vec3 upper, std::uint8_t material);

    std::uint8_t at(int x, int y, int z) const { return blocks_[index(x, y, z)]; }

    /// Adds the surface. Faces below the grid are left out; those at its sides are there.
    void add_surface(MeshBuilder& mesh) const;

  private:
    /// Of a layer of blocks towards one side; kEmpty: none.
    struct Faces {
        int rows, width;
        std::vector<std::uint8_t> materials;
        std::uint8_t* at(int row, int i) {
            return materials.data() + std::size_t(row) * std::size_t(width) + std::size_t(i);
        }
    };

    std::size_t index(int x, int y, int z) const {
        return (std::size_t(z) * std::size_t(size_.x) + std::size_t(x)) * std::size_t(size_.y) + std::size_t(y);
    }
    bool find_faces(int axis, int plane, int side, Faces& faces) const;
    void add_plane(MeshBuilder& mesh, int axis, int plane, int side, Faces& faces) const;
    void add_face(MeshBuilder& mesh, int axis, int side, glm::ivec3 lower, glm::ivec3 upper,
                  std::uint8_t material) const;

    glm::ivec3 size_;
    glm::vec3 lower_;
    float edge_;
    int top_ = 0;                      ///< no block at or above
    std::vector<std::uint8_t> blocks_; ///< y fastest: columns are short
};

} // namespace manylights::lab
