#pragma once
// Cameras of the lab: right-handed world, y up, looking along `forward`.

#include <manylights/manylights.h>

#include <glm/glm.hpp>

#include <string>

namespace manylights::lab {

struct Camera {
    std::string name;
    glm::vec3 position{0.0f};             ///< world space
    glm::vec3 forward{0.0f, 0.0f, -1.0f}; ///< unit length, world space
    glm::vec3 up{0.0f, 1.0f, 0.0f};       ///< not parallel to forward; need not be orthogonal to it
    float vertical_fov = 1.04719755f;     ///< radians; 60 degrees
    float near_plane = 0.1f;              ///< scene unit, > 0; the far plane is at infinity
};

/// The axes of the camera in world space, orthonormal: what turns a pixel and a depth into a camera-relative point
/// (relative to the camera's position, along the world's axes).
struct CameraBasis {
    glm::vec3 right, up, forward;
    float tan_half_x, tan_half_y; ///< half extents of the image at depth 1
};

CameraBasis camera_basis(const Camera& camera, std::uint32_t width, std::uint32_t height);

/// Vulkan clip space (y down), reversed depth, infinite far plane.
ManylightsView make_view(const Camera& camera, std::uint32_t width, std::uint32_t height);

} // namespace manylights::lab
