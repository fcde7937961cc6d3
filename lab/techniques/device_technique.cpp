#include "lab/techniques/device_technique.h"

#include "lab/renderer/point_buffer.h"

namespace manylights::lab {

namespace {

std::optional<std::uint32_t> affecting_light(const LightStream& lights, const std::vector<PointPosition>& points) {
    for (const PointPosition& point : points) {
        if (point.depth == 0.0f) continue;
        const std::vector<std::uint32_t> found = affecting_lights(lights, point.position);
        if (!found.empty()) return found.front();
    }
    return std::nullopt;
}

} // namespace

void DeviceTechnique::prepare(const Frame& frame) {
    lights_.emplace(device_, frame);
    spheres_.emplace(device_, "spheres to build from", std::span<const glm::vec4>(lights_->stream.spheres));
    stats_ = {};
    build(frame);
}

bool DeviceTechnique::remove_one_reference(const Frame& frame) {
    std::vector<glm::vec4> spheres = lights().stream.spheres;
    const auto light = affecting_light(lights().stream, frame.points.download_positions());
    if (!light) return false;
    spheres[*light].w = 0.0f;
    spheres_->upload(spheres);
    build(frame);
    return true;
}

} // namespace manylights::lab
