#include "lab/techniques/light_stream.h"

#include <manylights/format.h>

#include <algorithm>
#include <cmath>

namespace manylights::lab {

namespace {

// Larger ranges count as this one (manylights.h), so that the squared range stays finite.
constexpr float kLargestRange = 1e18f;

glm::vec4 relative_sphere(const ManylightsSphere& sphere, const glm::vec3& camera) {
    const float* center = sphere.center;
    const bool usable = std::isfinite(center[0]) && std::isfinite(center[1]) && std::isfinite(center[2]) &&
                        sphere.range >= 0.0f; // false for NaN
    if (!usable) return glm::vec4(0.0f);
    return {center[0] - camera.x, center[1] - camera.y, center[2] - camera.z, std::min(sphere.range, kLargestRange)};
}

} // namespace

ManylightsLights public_lights(const Frame& frame) {
    ManylightsLights lights{};
    lights.size = sizeof lights;
    lights.spheres = frame.lights.empty() ? nullptr : &frame.lights.front().sphere;
    lights.sphere_stride = sizeof(Light);
    lights.count = static_cast<std::uint32_t>(frame.lights.size());
    return lights;
}

LightStream make_light_stream(const Frame& frame) {
    LightStream stream;
    stream.spheres.reserve(frame.lights.size() + 1);
    stream.colors.reserve(frame.lights.size() + 1);
    for (const Light& light : frame.lights) {
        stream.spheres.push_back(relative_sphere(light.sphere, frame.camera.position));
        stream.colors.emplace_back(light.color[0], light.color[1], light.color[2], 0.0f);
    }
    stream.spheres.emplace_back(0.0f);
    stream.colors.emplace_back(0.0f);
    return stream;
}

std::vector<std::uint32_t> affecting_lights(const LightStream& lights, const glm::vec3& point) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < lights.light_count(); ++i) {
        const glm::vec4& sphere = lights.spheres[i];
        if (ml_affects({point.x, point.y, point.z}, {sphere.x, sphere.y, sphere.z}, sphere.w)) found.push_back(i);
    }
    return found;
}

} // namespace manylights::lab
