#pragma once
// The pinned points in tests/data/points with the lights that are put around them: the same on every machine, so the
// light sets are numbers.

#include "lab/renderer/saved_points.h"
#include "lab/scene/scene.h"

namespace manylights::lab {

struct PinnedView {
    const char* scene;
    const char* distribution;
    const char* radius;
    std::uint64_t light_set_hash; ///< of the image (lab/techniques/verification.h)
    std::uint64_t affecting;      ///< lights, summed over the points
};

/// 4,096 lights of seed 1 each, with radii that let about 6 lights affect a point.
constexpr std::uint32_t kPinnedLights = 4096;
constexpr PinnedView kPinnedViews[] = {
    {"canyon", "view", "auto", 0x174C4C1D304C3FA0u, 3873},
    {"citadel", "volume", "40:160", 0xEB918EFF19A8522Cu, 2221},
    {"bars", "volume", "2:30", 0xB9A6F752E53CEF7Fu, 3966},
    {"cornell", "surface", "auto", 0x42749B7B98EA9203u, 1749},
};

struct LoadedView {
    Scene scene;
    SavedPoints saved;
    std::vector<Light> lights;
};
LoadedView load_view(const PinnedView& pinned);

} // namespace manylights::lab
