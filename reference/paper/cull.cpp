#include "reference/paper/cull.h"

#include <cmath>

namespace manylights::paper {
namespace {

constexpr float kLargestRange = 1e18f;
// Beyond this size squares leave float. Such a light is handed to every cell: coarse, never wrong.
constexpr float kLargestExtent = 1e18f;

// r' = r + 1e-6 (r + |c|) + 4 ulp of the largest world coordinate; 4 ulp are at most 2^-21 of it, and it is at most the
// camera's largest one + |c| + r. The sum of the absolute coordinates stands for |c|: not smaller, and without a root.
// Conservative: covers the rotation (below 5e-7 |c|), the predicate's own rounding (below 5e-7 r), and shading points
// that were rounded in world space.
constexpr float kRelativeSlack = 1e-6f + 0x1p-21f;

// A side plane through the eye, in two dimensions: inside where a * side + b * depth >= 0; (a, b) has unit length.
struct SidePlane {
    float a, b;
};

// scale * side / depth >= -reach, for the side of small pixel positions; reach = distance in pixels from the image's
// centre line to the border that still counts.
SidePlane side_plane(float scale, float reach) {
    const float length = std::sqrt(scale * scale + reach * reach);
    return {scale / length, reach / length};
}

float dot(const float* row, float x, float y, float z) { return row[0] * x + row[1] * y + row[2] * z; }

} // namespace

// Every test is written as "keep if", so that NaN drops out; a light is dropped only where the whole sphere is in front
// of the near plane or beyond a side plane. There is no far plane: the last slice is open.
CullCounts cull(const Camera& camera, float widening_px, const ManylightsLights& lights,
                FlatArray<CulledLight>& culled) {
    const float border = camera.guard_px + widening_px;
    const SidePlane left = side_plane(camera.scale_x, camera.center_x + border);
    const SidePlane right = side_plane(camera.scale_x, float(camera.width) - camera.center_x + border);
    const SidePlane top = side_plane(camera.scale_y, camera.center_y + border);
    const SidePlane bottom = side_plane(camera.scale_y, float(camera.height) - camera.center_y + border);
    const std::size_t stride = lights.sphere_stride != 0 ? lights.sphere_stride : sizeof(ManylightsSphere);
    const char* bytes = static_cast<const char*>(lights.spheres);
    CulledLight* out = culled.require(lights.count + std::size_t{1}); // one beyond: a dropped light is written, too
    CullCounts counts{0, 0};

    for (std::uint32_t i = 0; i < lights.count; ++i) {
        const auto& sphere = *reinterpret_cast<const ManylightsSphere*>(bytes + i * stride);
        const float finite = (sphere.center[0] + sphere.center[1] + sphere.center[2]) * 0.0f;
        const bool good = (finite == 0.0f) & (sphere.range >= 0.0f);
        counts.ignored += !good;

        const float cx = sphere.center[0] - camera.position[0];
        const float cy = sphere.center[1] - camera.position[1];
        const float cz = sphere.center[2] - camera.position[2];
        const float range = (sphere.range < kLargestRange ? sphere.range : kLargestRange) + lights.motion_margin;
        const float extent = std::abs(cx) + std::abs(cy) + std::abs(cz) + range;
        const float radius = range + kRelativeSlack * extent + camera.position_slack;

        const float x = dot(camera.right_from_world, cx, cy, cz);
        const float y = dot(camera.down_from_world, cx, cy, cz);
        const float depth = dot(camera.depth_from_world, cx, cy, cz);
        const bool everywhere = !(extent < kLargestExtent);
        const bool inside = (depth + radius >= camera.near_depth) & (left.a * x + left.b * depth >= -radius) &
                            (right.b * depth - right.a * x >= -radius) & (top.a * y + top.b * depth >= -radius) &
                            (bottom.b * depth - bottom.a * y >= -radius);
        // Written always and kept by advancing: which lights are in view is not predictable.
        out[counts.kept] = {x, y, depth, radius, i};
        if (everywhere) out[counts.kept] = {0.0f, 0.0f, 0.0f, INFINITY, i};
        counts.kept += good & (sphere.range > 0.0f) & (inside | everywhere);
    }
    return counts;
}

} // namespace manylights::paper
