#pragma once
// The first stage: which lights are in view, and what they cover there.

#include "src/build/array.h"
#include "src/build/camera.h"
#include "src/build/slices.h"

#include <cstdint>

namespace manylights::detail {

// A light in a view: everything that the later stages need of it.
struct VisibleLight {
    std::uint32_t index; // the caller's
    float min_depth;
    float max_depth;
    float center_depth;
    std::uint16_t first_px[2], last_px[2]; // x, y
    std::uint8_t first_slice, last_slice;
};

// Its sphere, for stages that narrow what it covers.
struct ViewSphere {
    double center[3]; // along view x, view y and depth
    double radius;    // culling_radius
};

struct View {
    Camera camera;
    Array<VisibleLight> lights;   // ascending index
    Array<ViewSphere> spheres;    // of the lights, where they are kept
    Array<std::uint32_t> visible; // their indices, for the caller
};

struct CullResult {
    std::uint64_t ignored_lights;
    std::uint64_t first_ignored;
    bool out_of_memory;
};

// One pass over the lights serves all views.
CullResult cull_lights(const ManylightsLights& lights, const Slices& slices, bool keeps_spheres, View* views,
                       std::uint32_t view_count);

// The radius that culling uses instead of the range. distance: of the light from the camera; world_extent: the largest
// |world coordinate| of light and camera.
double culling_radius(double range, double motion_margin, double distance, double world_extent, double skew);

} // namespace manylights::detail
