#include "reference/oracle/light_set.h"

#include "reference/oracle/light_hash.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace manylights::oracle {

bool is_usable(const ManylightsSphere& sphere) {
    return std::isfinite(sphere.center[0]) && std::isfinite(sphere.center[1]) && std::isfinite(sphere.center[2]) &&
           sphere.range >= 0.0f;
}

ManylightsSphere sphere_at(const ManylightsLights& lights, std::uint32_t index) {
    std::size_t stride = lights.sphere_stride == 0 ? sizeof(ManylightsSphere) : lights.sphere_stride;
    ManylightsSphere sphere;
    std::memcpy(&sphere, static_cast<const char*>(lights.spheres) + index * stride, sizeof sphere);
    return sphere;
}

std::vector<RelativeLight> relative_lights(const ManylightsLights& lights, const float eye[3]) {
    std::vector<RelativeLight> result;
    for (std::uint32_t i = 0; i < lights.count; ++i) {
        ManylightsSphere sphere = sphere_at(lights, i);
        if (is_usable(sphere))
            result.push_back({camera_relative(sphere.center, eye), std::min(sphere.range, kLargestRange), i});
    }
    return result;
}

void LightSet::add(std::uint32_t light) {
    indices.push_back(light);
    hash_a += light_hash_a(light);
    hash_b += light_hash_b(light);
}

LightSet affecting_lights(MlFloat3 point, const std::vector<RelativeLight>& lights) {
    LightSet set;
    for (const RelativeLight& light : lights)
        if (ml_affects(point, light.center, light.range)) set.add(light.index);
    return set;
}

double distance_to_surface(MlFloat3 point, const RelativeLight& light) {
    return length(to_double(point) - to_double(light.center)) - light.range;
}

} // namespace manylights::oracle
