#include "lab/techniques/device/device_view.h"

namespace manylights::lab {

namespace {

// As the library reaches (src/build/bounds.cpp): half a pixel, 0.05 pixels and 1e-5 of the image for rounding.
float reach_of(std::uint32_t size) { return 0.55f + 1e-5f * static_cast<float>(size); }

} // namespace

DeviceView device_view(const Frame& frame) {
    const CameraBasis basis = camera_basis(frame.camera, frame.width, frame.height);
    DeviceView view{};
    view.right = glm::vec4(basis.right, 0.5f * static_cast<float>(frame.width) / basis.tan_half_x);
    view.down = glm::vec4(-basis.up, 0.5f * static_cast<float>(frame.height) / basis.tan_half_y);
    view.forward = glm::vec4(basis.forward, frame.camera.near_plane);
    view.width = frame.width;
    view.height = frame.height;
    view.reach = {reach_of(frame.width), reach_of(frame.height)};
    return view;
}

} // namespace manylights::lab
