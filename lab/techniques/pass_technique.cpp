#include "lab/techniques/pass_technique.h"

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

PassTechnique::PassTechnique(gpu::Device& device, TechniqueInfo info, const PassShaders& shaders)
    : device_(device), info_(std::move(info)), pass_(device, shaders, LightSplit::none) {}

void PassTechnique::prepare(const Frame& frame) {
    lights_.emplace(device_, frame);
    spheres_.emplace(device_, "spheres to build from", std::span<const glm::vec4>(lights_->stream.spheres));
    stats_ = {};
    build(frame);
}

std::vector<PixelRecord> PassTechnique::record(const Frame& frame) {
    return pass_.record(frame, lights_.value(), one_band(frame, structure()));
}

std::vector<float> PassTechnique::shade(const Frame& frame) {
    return pass_.shade(frame, lights_.value(), one_band(frame, structure()), stats_.shade_ms);
}

WaveSummary PassTechnique::waves(const Frame& frame) {
    return pass_.waves(frame, lights_.value(), one_band(frame, structure()));
}

bool PassTechnique::remove_one_reference(const Frame& frame) {
    std::vector<glm::vec4> spheres = lights_.value().stream.spheres;
    const auto light = affecting_light(lights_.value().stream, frame.points.download_positions());
    if (!light) return false;
    spheres[*light].w = 0.0f;
    spheres_->upload(spheres);
    build(frame);
    return true;
}

} // namespace manylights::lab
