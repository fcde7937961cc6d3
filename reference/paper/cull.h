#pragma once
// Frustum culling of spheres (TLT section 3: the first step on the CPU).

#include "reference/paper/camera.h"
#include "reference/paper/flat_array.h"

namespace manylights::paper {

/// A light that may be in view.
struct CulledLight {
    float x, y, depth; ///< view space, axes of Camera
    float radius;      ///< culling radius: the range and what rounding may take from it; +inf: affects everything
    std::uint32_t index;
};

struct CullCounts {
    std::uint32_t kept, ignored; ///< ignored: non-finite or negative
};

/// Keeps the order of the lights. widening_px: how far beyond guard_px the image reaches.
CullCounts cull(const Camera& camera, float widening_px, const ManylightsLights& lights,
                FlatArray<CulledLight>& culled);

} // namespace manylights::paper
