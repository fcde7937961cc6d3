#include "tests/property/promise.h"

#include <algorithm>
#include <cmath>

namespace manylights::test {

namespace {

const double kDepthTolerance = std::ldexp(1.0, -20);

/// Along one axis: centres of the first and the last promised pixel of each tile.
std::vector<float> promised_centres(double position, double guard, std::uint32_t size, std::uint32_t tile_px) {
    double first = std::max(0.0, std::ceil(position - guard - 0.5));
    double last = std::min(size - 1.0, std::floor(position + guard - 0.5));
    std::vector<float> centres;
    if (!(first <= last)) return centres;
    std::uint32_t end = static_cast<std::uint32_t>(last);
    for (std::uint32_t pixel = static_cast<std::uint32_t>(first); pixel <= end;) {
        std::uint32_t last_of_tile = std::min(end, pixel / tile_px * tile_px + (tile_px - 1));
        centres.push_back(static_cast<float>(pixel) + 0.5f);
        if (last_of_tile != pixel) centres.push_back(static_cast<float>(last_of_tile) + 0.5f);
        pixel = last_of_tile + 1;
    }
    return centres;
}

std::vector<float> query_depths(double depth, const std::vector<float>& extra) {
    std::vector<float> depths = promised_depths(depth);
    for (float d : extra)
        if (is_promised_depth(d, depth)) depths.push_back(d);
    return depths;
}

} // namespace

std::vector<MlFloat2> promised_pixels(const oracle::Camera& camera, std::uint32_t tile_px,
                                      oracle::ScreenPosition screen) {
    double guard = camera.view.guard_px;
    std::vector<MlFloat2> pixels;
    for (float y : promised_centres(screen.y, guard, camera.view.height, tile_px))
        for (float x : promised_centres(screen.x, guard, camera.view.width, tile_px)) pixels.push_back({x, y});
    return pixels;
}

bool is_promised_depth(float query_depth, double depth) {
    return std::fabs(query_depth - depth) <= depth * kDepthTolerance;
}

std::vector<float> promised_depths(double depth) {
    float nearest = static_cast<float>(depth);
    float least = static_cast<float>(depth * (1.0 - kDepthTolerance));
    float greatest = static_cast<float>(depth * (1.0 + kDepthTolerance));
    if (!is_promised_depth(least, depth)) least = std::nextafter(least, INFINITY);
    if (!is_promised_depth(greatest, depth)) greatest = std::nextafter(greatest, 0.0f);
    return {least, nearest, greatest};
}

bool is_between_planes(const oracle::Camera& camera, oracle::ScreenPosition screen) {
    if (!(screen.depth > camera.near_depth * (1.0 + 1e-5))) return false;
    if (screen.depth <= camera.far_depth) return true;
    // What the rasteriser sees: clip z and w as the vertex stage computes them.
    const float* m = camera.view.clip_from_view;
    float view_z = static_cast<float>(m[11] < 0.0f ? -screen.depth : screen.depth);
    float clip_z = m[10] * view_z + m[14];
    float clip_w = m[11] * view_z;
    bool reversed = m[14] > 0.0f;
    return reversed ? clip_z >= 0.0f : clip_z <= clip_w;
}

void check_point(const Frame& frame, std::size_t view, const oracle::Camera& camera, MlFloat3 point,
                 const std::vector<std::uint32_t>& affecting, Outcome& outcome,
                 const std::vector<float>& extra_depths) {
    oracle::ScreenPosition screen = oracle::project(camera, point);
    if (!is_between_planes(camera, screen)) return;
    std::vector<MlFloat2> pixels = promised_pixels(camera, frame.view(view).tile_px, screen);
    if (pixels.empty()) return;
    std::vector<bool> lost(affecting.size(), false);
    for (float depth : query_depths(screen.depth, extra_depths))
        for (MlFloat2 pixel : pixels) {
            std::vector<std::uint32_t> handed_out = frame.query(view, pixel.x, pixel.y, depth);
            ++outcome.queries;
            for (std::size_t i = 0; i < affecting.size(); ++i)
                if (std::count(handed_out.begin(), handed_out.end(), affecting[i]) != 1) lost[i] = true;
        }
    outcome.triples += affecting.size();
    outcome.lost += static_cast<std::uint64_t>(std::count(lost.begin(), lost.end(), true));
}

void check_triple(const Frame& frame, std::size_t view, const oracle::Camera& camera, MlFloat3 point,
                  std::uint32_t light, Outcome& outcome, const std::vector<float>& extra_depths) {
    check_point(frame, view, camera, point, {light}, outcome, extra_depths);
}

} // namespace manylights::test
