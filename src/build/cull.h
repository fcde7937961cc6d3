#pragma once
// The first stage: which lights are in view, and what they cover there.

#include "src/build/camera.h"
#include "src/build/settings.h"
#include "src/build/view_lights.h"

#include <cstdint>

namespace manylights::detail {

struct View {
    Camera camera;
    ViewLights lights;
    Array<std::uint32_t> visible; // their indices, for the caller
};

// Lights that are ignored: how many, and the first one's index (if any).
struct Ignored {
    std::uint64_t count, first;
};
inline Ignored add_ignored(const Ignored& earlier, const Ignored& later) {
    return {earlier.count + later.count, earlier.count != 0 ? earlier.first : later.first};
}

// Makes the list of the visible lights out of the blocks' indices and counts. False: out of memory.
[[nodiscard]] bool list_visible(View& view);

// The radius that culling uses instead of the range. distance: of the light from the camera; world_extent: the largest
// |world coordinate| of light and camera.
double culling_radius(double range, double motion_margin, double distance, double world_extent, double skew);

// Ranges beyond this one reach everything: it stands for infinity, so that no infinity enters a formula (its square
// fits a float, so membership works up to here).
constexpr float kEverywhere = 1e18f;

// Some of the caller's lights.
struct LightSpan {
    const char* spheres;
    std::size_t stride;
    std::uint32_t first, count; // index of the first; at most kBlockLights
};

LightSpan whole_span(const ManylightsLights& lights); // of any length
LightSpan block_span(const ManylightsLights& lights, std::uint64_t block);

// What culling in floats needs to know of a view; all of it rounded to the side that keeps more.
struct ViewCull {
    const Camera* camera;
    float position[3], rotation[3][3];
    float motion_margin;
    float world_slack; // the culling radius grows by slack * (reach + |c|) + world_slack * world extent
    float slack;
    float position_extent;
    float near_depth, far_depth;
    float side_offset[4], side_depth[4]; // normals of the image's side planes: least x, greatest x, the same in y
    float scale[2], origin[2], reach[2], last_px[2];
    bool has_float_bounds; // the pixels of the image are close enough to each other for floats
};

ViewCull make_view_cull(const Camera& camera, float motion_margin);

// A light for which floats will not do: it meets the camera's plane, or is extreme. False: not in view.
struct FoundLight {
    float x, y, depth, radius;
    std::uint32_t pixels_x, pixels_y;
};
// From its sphere in the view, of ordinary size.
bool find_bounds(const ViewCull& cull, FoundLight& found);
// From the beginning. range in (0, kEverywhere].
bool find_in_view(const ViewCull& cull, const ManylightsSphere& light, FoundLight& found);

// Culls some lights into a block, and sets its count.
Ignored cull_block(const ViewCull& cull, const LightSpan& lights, LightBlock& block);

} // namespace manylights::detail
