#pragma once
// A frame's camera as shaders see it that build structures on the device: device_view.glsl has the same text.

#include "lab/techniques/technique.h"

#include <glm/glm.hpp>

namespace manylights::lab {

/// Axes of the world; light positions are relative to the camera along them. 64 bytes.
struct DeviceView {
    glm::vec4 right;      ///< w: pixels per unit of slope across
    glm::vec4 down;       ///< w: pixels per unit of slope down
    glm::vec4 forward;    ///< w: near plane
    std::uint32_t width;  ///< pixels
    std::uint32_t height; ///< pixels
    glm::vec2 reach;      ///< pixels across and down: how far from a pixel's centre its points may project
};
static_assert(sizeof(DeviceView) == 64);

DeviceView device_view(const Frame& frame);

} // namespace manylights::lab
