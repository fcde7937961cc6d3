#include "src/build/cull.h"

#include "src/build/bounds.h"
#include "src/build/narrow.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace manylights::detail {

namespace {

constexpr double kFloatMax = std::numeric_limits<float>::max();

double largest_coordinate(const float (&p)[3]) { return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}); }

// The nearest float that is not below, or not above. Twice 2^-24 is more than the rounding of what is not denormal.
float float_above(double x) { return static_cast<float>(std::min(x + std::fabs(x) * 0x1p-23 + 1e-44, kFloatMax)); }
float float_below(double x) { return -float_above(-x); }

bool set_pixels(const ViewCull& cull, const double (&center)[3], double radius, FoundLight& found) {
    std::uint32_t* const pixels[2] = {&found.pixels_x, &found.pixels_y};
    for (int i = 0; i < 2; ++i) {
        const Interval slopes = slope_bounds(center[i], center[2], radius, cull.camera->near_depth);
        const PixelRange range = pixel_bounds(cull.camera->axes[i], slopes, cull.camera->guard_px);
        if (range.empty) return false;
        *pixels[i] = range.first | range.last << 16;
    }
    return true;
}

bool is_between_planes(const Camera& camera, double depth, double radius) {
    // Conservative: near_depth lies before the near plane, far_depth behind the far plane, radius outside the light.
    return depth + radius >= camera.near_depth && depth - radius <= camera.far_depth;
}

} // namespace

LightSpan whole_span(const ManylightsLights& lights) {
    const std::size_t stride = lights.sphere_stride != 0 ? lights.sphere_stride : sizeof(ManylightsSphere);
    return {static_cast<const char*>(lights.spheres), stride, 0, lights.count};
}

LightSpan block_span(const ManylightsLights& lights, std::uint64_t block) {
    LightSpan span = whole_span(lights);
    span.first = static_cast<std::uint32_t>(block * kBlockLights);
    span.spheres += span.first * span.stride;
    span.count = std::min(lights.count - span.first, kBlockLights);
    return span;
}

bool list_visible(View& view) {
    view.lights.count = 0;
    for (std::uint64_t b = 0; b < view.lights.counts.size(); ++b) view.lights.count += view.lights.counts[b];
    if (!view.visible.resize(view.lights.count)) return false;
    std::uint64_t begin = 0;
    for (std::uint64_t b = 0; b < view.lights.counts.size(); ++b) {
        const std::uint32_t count = view.lights.counts[b];
        if (count == 0) continue;
        std::memcpy(view.visible.data() + begin, view.lights.index.data() + b * kBlockRoom,
                    count * sizeof(std::uint32_t));
        begin += count;
    }
    return true;
}

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

// The same radius in floats, with d the sum of |coordinates| of c instead of its length, is
// reach + slack * (reach + d) + world_slack * extent + 1e-20. Beyond what culling_radius adds:
//   * skew multiplies also the rounding terms; 2^-9 of them is more than skew, which is 1e-3 at most;
//   * the centre in view space is off by 4u * |row| * |c| per axis (three products, two sums), 7u * |c| in length;
//   * this formula itself rounds six times, each by u of the radius at most.
// The last two are less than 8e-7 * (reach + d).
ViewCull make_view_cull(const Camera& camera, float motion_margin) {
    ViewCull cull{};
    cull.camera = &camera;
    for (int i = 0; i < 3; ++i) {
        cull.position[i] = camera.position[i];
        for (int k = 0; k < 3; ++k) cull.rotation[i][k] = static_cast<float>(camera.rotation[i][k]); // exact
    }
    cull.motion_margin = motion_margin;
    cull.slack = float_above(1.81e-6 + (1.0 + 0x1p-8) * camera.skew);
    cull.world_slack = float_above(4.0 * 0x1p-23 * (1.0 + 0x1p-8));
    cull.position_extent = float_above(camera.position_extent);
    cull.near_depth = float_below(camera.near_depth);
    cull.far_depth =
        std::isinf(camera.far_depth) ? static_cast<float>(camera.far_depth) : float_above(camera.far_depth);
    cull.has_float_bounds = true;
    for (int i = 0; i < 2; ++i) {
        const Axis& axis = camera.axes[i];
        const TileWedge image = tile_wedge(axis, 0, axis.size - 1, camera.guard_px);
        for (int k = 0; k < 2; ++k) {
            cull.side_offset[2 * i + k] = static_cast<float>(image.sides[k].offset);
            cull.side_depth[2 * i + k] = static_cast<float>(image.sides[k].depth);
        }
        cull.scale[i] = static_cast<float>(axis.scale);
        cull.origin[i] = static_cast<float>(axis.origin);
        cull.reach[i] = float_above(guard_reach(axis, camera.guard_px) + float_bounds_slack(axis));
        cull.last_px[i] = static_cast<float>(axis.size - 1);
        cull.has_float_bounds = cull.has_float_bounds && floats_suffice(axis);
    }
    return cull;
}

bool find_bounds(const ViewCull& cull, FoundLight& found) {
    return set_pixels(cull, {found.x, found.y, found.depth}, found.radius, found);
}

bool find_in_view(const ViewCull& cull, const ManylightsSphere& light, FoundLight& found) {
    const Camera& camera = *cull.camera;
    double relative[3]; // to the camera, by the rule that membership uses: each coordinate rounded once to float
    for (int i = 0; i < 3; ++i) relative[i] = light.center[i] - camera.position[i];
    double center[3];
    for (int i = 0; i < 3; ++i) {
        const double* row = camera.rotation[i];
        center[i] = row[0] * relative[0] + row[1] * relative[1] + row[2] * relative[2];
    }
    const double distance =
        std::sqrt(relative[0] * relative[0] + relative[1] * relative[1] + relative[2] * relative[2]);
    // Farther away than floats reach: no point that can be shaded is as far.
    if (!(distance <= kFloatMax)) return false;
    const double world_extent = std::max(largest_coordinate(light.center), camera.position_extent);
    const double radius = culling_radius(light.range, cull.motion_margin, distance, world_extent, camera.skew);
    if (!is_between_planes(camera, center[2], radius) || !set_pixels(cull, center, radius, found)) return false;
    const auto to_float = [](double x) { return static_cast<float>(std::clamp(x, -kFloatMax, kFloatMax)); };
    found.x = to_float(center[0]);
    found.y = to_float(center[1]);
    found.depth = to_float(center[2]);
    found.radius = float_above(radius + 0x1p-22 * distance); // the centre was rounded
    return true;
}

} // namespace manylights::detail
