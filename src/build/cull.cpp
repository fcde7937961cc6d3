#include "src/build/cull.h"

#include "src/build/bounds.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace manylights::detail {

namespace {

// Ranges beyond this one reach everything: it stands for infinity, so that no infinity enters a formula (its square
// fits a float, so membership works up to here).
constexpr float kEverywhere = 1e18f;

bool is_finite(float x) { return std::fabs(x) <= std::numeric_limits<float>::max(); }

// "Keep if" forms: a NaN fails every comparison.
bool is_usable(const ManylightsSphere& light) {
    return is_finite(light.center[0]) && is_finite(light.center[1]) && is_finite(light.center[2]) &&
           light.range >= 0.0f;
}

double largest_coordinate(const float (&p)[3]) { return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}); }

// light.range in (0, kEverywhere].
bool find_in_view(const ManylightsSphere& light, double motion_margin, const Slices& slices, const Camera& camera,
                  VisibleLight& found, ViewSphere& sphere) {
    double relative[3]; // to the camera, by the rule that membership uses: each coordinate rounded once to float
    for (int i = 0; i < 3; ++i) relative[i] = light.center[i] - camera.position[i];
    double(&center)[3] = sphere.center;
    for (int i = 0; i < 3; ++i) {
        const double* row = camera.rotation[i];
        center[i] = row[0] * relative[0] + row[1] * relative[1] + row[2] * relative[2];
    }
    const double distance =
        std::sqrt(relative[0] * relative[0] + relative[1] * relative[1] + relative[2] * relative[2]);
    // Farther away than floats reach: no point that can be shaded is as far.
    if (!(distance <= std::numeric_limits<float>::max())) return false;

    const double world_extent = std::max(largest_coordinate(light.center), camera.position_extent);
    const double radius = culling_radius(light.range, motion_margin, distance, world_extent, camera.skew);
    sphere.radius = radius;
    const double depth = center[2];
    // Conservative: near_depth lies before the near plane, far_depth behind the far plane, radius outside the light.
    if (!(depth + radius >= camera.near_depth && depth - radius <= camera.far_depth)) return false;
    for (int i = 0; i < 2; ++i) {
        const Interval slopes = slope_bounds(center[i], depth, radius, camera.near_depth);
        const PixelRange pixels = pixel_bounds(camera.axes[i], slopes, camera.guard_px);
        if (pixels.empty) return false;
        found.first_px[i] = static_cast<std::uint16_t>(pixels.first);
        found.last_px[i] = static_cast<std::uint16_t>(pixels.last);
    }
    const DepthRange depths = depth_bounds(depth, radius);
    found.min_depth = depths.low;
    found.max_depth = depths.high;
    found.center_depth = static_cast<float>(std::clamp(depth, -3e38, 3e38));
    found.first_slice = static_cast<std::uint8_t>(slice_of(slices, depths.low));
    found.last_slice = static_cast<std::uint8_t>(slice_of(slices, depths.high));
    return true;
}

ManylightsSphere load_light(const ManylightsLights& lights, std::size_t stride, std::uint32_t index) {
    ManylightsSphere light;
    std::memcpy(&light, static_cast<const char*>(lights.spheres) + index * stride, sizeof(light));
    light.range = std::min(light.range, kEverywhere); // a NaN stays one
    return light;
}

} // namespace

// Why the culling radius contains every point that the membership rule accepts, with u = 2^-24, c the light and p the
// point relative to the camera:
//   * p and c are rounded once, which moves them by at most u * |p| <= u * (|c| + r) and u * |c|;
//   * d^2 and r^2 in float are off by about 4u + u relative, so a point may be accepted at r * (1 + 3u).
//   Together less than 4u * r + 2u * |c| < 3e-7 * (r + |c|). 1e-6 * (r + |c|) leaves twice that for a shader's own
//   transform to view space in float.
//   * Where squares underflow (ranges near 1e-22) the bounds above fail; 1e-20 covers them.
//   * A renderer that shades in world space rounds the point (half an ulp per axis, 0.9 in length), recomputes its
//     depth with a translation of the world's size (about 2 ulp), and has a camera position that is not quite the one
//     found here (0.9): less than 4 ulp of the largest world coordinate, which 4 * 2^-23 times it is at least.
//   * A matrix that is not quite a rotation stretches the sphere by 1 + skew at most, and one that was made a rotation
//     again elsewhere turns the centre by skew * |c|.
double culling_radius(double range, double motion_margin, double distance, double world_extent, double skew) {
    const double reach = range + motion_margin;
    const double rounding = 1e-6 * (reach + distance) + 4.0 * 0x1p-23 * world_extent + 1e-20;
    return (reach + rounding) * (1.0 + skew) + skew * distance;
}

CullResult cull_lights(const ManylightsLights& lights, const Slices& slices, bool keeps_spheres, View* views,
                       std::uint32_t view_count) {
    CullResult result{};
    for (std::uint32_t v = 0; v < view_count; ++v) {
        views[v].lights.clear();
        views[v].spheres.clear();
        views[v].visible.clear();
    }
    const std::size_t stride = lights.sphere_stride != 0 ? lights.sphere_stride : sizeof(ManylightsSphere);
    for (std::uint32_t i = 0; i < lights.count; ++i) {
        const ManylightsSphere light = load_light(lights, stride, i);
        if (!is_usable(light)) {
            if (result.ignored_lights++ == 0) result.first_ignored = i;
            continue;
        }
        if (!(light.range > 0.0f)) continue; // strict membership: no point is nearer than 0
        VisibleLight found{};
        ViewSphere sphere{};
        found.index = i;
        for (std::uint32_t v = 0; v < view_count; ++v) {
            if (!find_in_view(light, lights.motion_margin, slices, views[v].camera, found, sphere)) continue;
            if (!views[v].lights.push(found) || !views[v].visible.push(i) ||
                (keeps_spheres && !views[v].spheres.push(sphere))) {
                result.out_of_memory = true;
                return result;
            }
        }
    }
    return result;
}

} // namespace manylights::detail
