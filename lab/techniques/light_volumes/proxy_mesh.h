#pragma once
// The mesh that stands for a sphere: an icosahedron, each of whose triangles is divided into four, as often as `level`
// says, with the new corners moved out to the sphere.

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace manylights::lab {

struct ProxyMesh {
    /// Three to a triangle, counter-clockwise from outside. Corners that triangles share are equal bit for bit, so that
    /// these have no gap between them. The unit sphere is inside the mesh: it touches its nearest faces.
    std::vector<glm::vec4> corners;
    float reach; ///< of the corners from the middle
};

ProxyMesh make_proxy_mesh(std::uint32_t level);

} // namespace manylights::lab
