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
    std::uint32_t count = 65536;         ///< for `file`: at most this many of the file's lights
    std::string distribution = "volume"; ///< volume, surface, surface-largest, groups, view, file
    std::uint32_t seed = 1;
    std::string radius = "auto"; ///< auto: the scene's radii times one factor, so that 6 lights affect a visible point;
                                 ///< mix: 99.8% in [1, 6] and 0.2% in [20, 40]; MIN:MAX: uniform. `view` has its own
                                 ///< radii with auto, and `file` its own always.
};

struct LightSet {
    std::vector<Light> lights;
    float radius_scale = 1.0f; ///< the factor that `auto` chose
};

struct Camera;
/// camera: for the distribution `view` only, as an image of 16:9. Throws InputError naming the option and the choices.
LightSet make_lights(const Scene& scene, const Camera& camera, const LightOptions& options);

} // namespace manylights::lab
