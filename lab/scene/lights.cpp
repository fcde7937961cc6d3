#include "lab/scene/lights.h"

#include "lab/scene/error.h"
#include "lab/scene/random.h"
#include "lab/scene/scene.h"

namespace manylights::lab {

std::vector<DistributionInfo> distributions() {
    return {{"volume", "uniform in the scene's light box"},
            {"surface", "near all triangles, by area"},
            {"surface-largest", "near the 1,000 largest triangles, by area"},
            {"groups", "1,000 clusters, uniform in the light box"},
            {"view", "uniform in the camera's view depth"},
            {"file", "the file's own lights"}};
}

LightSet make_lights(const Scene& scene, const Camera&, const LightOptions& options) {
    LightSet set;
    set.lights.resize(options.count);
    for (std::uint32_t i = 0; i < options.count; ++i) {
        Light& light = set.lights[i];
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            light.sphere.center[axis] = random_between(options.seed, i, axis, scene.light_box.lower[int(axis)],
                                                       scene.light_box.upper[int(axis)]);
        light.sphere.range = random_between(options.seed, i, 3, 2.0f, 8.0f);
        for (std::uint32_t c = 0; c < 3; ++c)
            light.color[c] =
                light.sphere.range * light.sphere.range * random_between(options.seed, i, 4 + c, 0.1f, 1.0f);
    }
    return set;
}

} // namespace manylights::lab
