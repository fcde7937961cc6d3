#include "lab/scene/builtin/block_grid.h"

#include <algorithm>
#include <cmath>

namespace manylights::lab {

namespace {

// The axes along which the faces across an axis extend; along the second one they lie side by side in memory.
constexpr int kOuterAxis[3] = {2, 2, 0}, kInnerAxis[3] = {1, 0, 1};

} // namespace

BlockGrid::BlockGrid(glm::ivec3 size, glm::vec3 lower, float edge)
    : size_(size), lower_(lower), edge_(edge),
      blocks_(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z), kEmpty) {}

void BlockGrid::fill(glm::vec3 lower, glm::vec3 upper, std::uint8_t material) {
    glm::ivec3 first, end;
    for (int axis = 0; axis < 3; ++axis) {
        first[axis] = std::max(int(std::ceil((lower[axis] - lower_[axis]) / edge_ - 0.5f)), 0);
        end[axis] = std::min(int(std::ceil((upper[axis] - lower_[axis]) / edge_ - 0.5f)), size_[axis]);
        if (first[axis] >= end[axis]) return;
    }
    for (int z = first.z; z < end.z; ++z) {
        for (int x = first.x; x < end.x; ++x) {
            const auto column = blocks_.begin() + std::ptrdiff_t(index(x, 0, z));
            std::fill(column + first.y, column + end.y, material);
        }
    }
    if (material != kEmpty) top_ = std::max(top_, end.y);
}

void BlockGrid::add_surface(MeshBuilder& mesh) const {
    for (int axis = 0; axis < 3; ++axis) {
        const int planes = axis == 1 ? top_ : size_[axis];
        Faces faces{size_[kOuterAxis[axis]], axis == 1 ? size_.x : top_, {}};
        faces.materials.resize(std::size_t(faces.rows) * std::size_t(faces.width));
        for (int plane = 0; plane < planes; ++plane) {
            for (const int side : {-1, 1}) add_plane(mesh, axis, plane, side, faces);
        }
    }
}

// The faces of a layer of blocks towards one side. Those at the sides of the grid have nothing in front of them; those
// at its bottom are left out.
bool BlockGrid::find_faces(int axis, int plane, int side, Faces& faces) const {
    const std::ptrdiff_t strides[3] = {size_.y, 1, std::ptrdiff_t(size_.x) * size_.y};
    const bool is_at_side = plane + side < 0 || plane + side >= size_[axis];
    if (is_at_side && axis == 1 && side < 0) return false;
    const std::uint8_t* row_start = blocks_.data() + plane * strides[axis];
    std::uint8_t* face = faces.materials.data();
    bool is_any = false;
    for (int row = 0; row < faces.rows; ++row, row_start += strides[kOuterAxis[axis]]) {
        const std::uint8_t* block = row_start;
        for (int i = 0; i < faces.width; ++i, ++face, block += strides[kInnerAxis[axis]]) {
            const bool is_open = is_at_side || block[side * strides[axis]] == kEmpty;
            *face = is_open ? *block : kEmpty;
            is_any |= *face != kEmpty;
        }
    }
    return is_any;
}

// Each face that is left grows along the inner axis as far as its material goes, then along the outer one as far as
// whole rows of it go.
void BlockGrid::add_plane(MeshBuilder& mesh, int axis, int plane, int side, Faces& faces) const {
    if (!find_faces(axis, plane, side, faces)) return;
    for (int row = 0; row < faces.rows; ++row) {
        for (int i = 0; i < faces.width; ++i) {
            const std::uint8_t material = *faces.at(row, i);
            if (material == kEmpty) continue;
            int end = i + 1, end_row = row + 1;
            while (end < faces.width && *faces.at(row, end) == material) ++end;
            const auto is_other = [&](std::uint8_t face) { return face != material; };
            const auto is_whole = [&](int r) {
                return std::none_of(faces.at(r, i), faces.at(r, i) + end - i, is_other);
            };
            while (end_row < faces.rows && is_whole(end_row)) ++end_row;
            for (int r = row; r < end_row; ++r) std::fill_n(faces.at(r, i), end - i, kEmpty);
            glm::ivec3 lower, upper;
            lower[axis] = plane, lower[kOuterAxis[axis]] = row, lower[kInnerAxis[axis]] = i;
            upper[axis] = plane + 1, upper[kOuterAxis[axis]] = end_row, upper[kInnerAxis[axis]] = end;
            add_face(mesh, axis, side, lower, upper, material);
        }
    }
}

void BlockGrid::add_face(MeshBuilder& mesh, int axis, int side, glm::ivec3 lower, glm::ivec3 upper,
                         std::uint8_t material) const {
    const glm::vec3 l = lower_ + glm::vec3(lower) * edge_, u = lower_ + glm::vec3(upper) * edge_;
    constexpr unsigned kSides[3][2] = {
        {kSideNegativeX, kSidePositiveX}, {kSideBottom, kSideTop}, {kSideNegativeZ, kSidePositiveZ}};
    mesh.box(l, u, kSides[axis][side > 0], material);
}

} // namespace manylights::lab
