#pragma once
// Lights of the lab, and the seeded distributions that make them. Light i depends only on (seed, i) and the scene, so a
// smaller count is a prefix of a larger one (up to the common factor of radius `auto`). Integer hashes and plain
// arithmetic only: the same lights on every machine.

#include <manylights/manylights.h>

#include <cstdint>
#include <string>
#include <vector>

namespace manylights::lab {

struct Scene;

struct Light {
    ManylightsSphere sphere;          ///< world space
    float color[3]{1.0f, 1.0f, 1.0f}; ///< linear radiant intensity
};

struct DistributionInfo {
    std::string name, summary;
};
std::vector<DistributionInfo> distributions();

struct LightOptions {
    std::uint32_t count = 65536;
    std::string distribution = "volume"; ///< volume, surface, surface-largest, groups, view, file
    std::uint32_t seed = 1;
    std::string radius = "auto"; ///< auto, mix, or MIN:MAX
};

struct LightSet {
    std::vector<Light> lights;
    float radius_scale = 1.0f; ///< the factor that `auto` chose
};

struct Camera;
/// camera: for the distribution `view` only. Throws InputError naming the option and the choices.
LightSet make_lights(const Scene& scene, const Camera& camera, const LightOptions& options);

} // namespace manylights::lab
