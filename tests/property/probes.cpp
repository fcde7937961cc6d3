#include "tests/property/probes.h"

#include <cmath>

namespace manylights::test {

namespace {

double forward(const oracle::Camera& camera) { return camera.view.clip_from_view[11] < 0.0f ? -1.0 : 1.0; }

} // namespace

std::uint32_t Trial::add_light(MlFloat3 center, float range) {
    spheres.push_back({{camera.eye[0] + center.x, camera.eye[1] + center.y, camera.eye[2] + center.z}, range});
    return static_cast<std::uint32_t>(spheres.size() - 1);
}

bool Trial::add_probe(MlFloat3 point, std::uint32_t light) {
    MlFloat3 center = oracle::camera_relative(spheres[light].center, camera.eye);
    if (!ml_affects(point, center, spheres[light].range)) return false;
    oracle::ScreenPosition screen = project(camera, point);
    bool in_view = is_between_planes(camera, screen) && screen.x >= 0.0 && screen.x < camera.view.width &&
                   screen.y >= 0.0 && screen.y < camera.view.height;
    if (in_view) probes.push_back({point, light});
    return in_view;
}

MlFloat3 relative_at(const oracle::Camera& camera, double x, double y, double depth) {
    return oracle::to_float(relative_from_view(camera, {x, y, depth * forward(camera)}));
}

oracle::Double3 depth_space(const oracle::Camera& camera, MlFloat3 relative) {
    oracle::Double3 v = view_from_relative(camera, oracle::to_double(relative));
    return {v.x, v.y, v.z * forward(camera)};
}

oracle::ScreenPosition project_slopes(const oracle::Camera& camera, double slope_x, double slope_y) {
    return project_view_space(camera, {slope_x, slope_y, forward(camera)});
}

oracle::Double3 slopes_at(const oracle::Camera& camera, double x, double y) {
    oracle::Double3 v = unproject_view_space(camera, {x, y, 1.0});
    return {v.x, v.y, 1.0};
}

oracle::Camera camera_at_origin(oracle::Random& random, std::uint32_t largest_edge_px) {
    const float eye[3] = {0.0f, 0.0f, 0.0f};
    oracle::CameraOptions options;
    options.largest_edge_px = largest_edge_px;
    oracle::Camera camera = random_camera_at(random, eye, options);
    camera.view.guard_px = std::fmin(camera.view.guard_px, 1.0f); // few pixels to ask at
    return camera;
}

void expect_none_lost(const Trial& trial, const ManylightsSettings& settings, Outcome& outcome) {
    for (ManylightsStructure structure : kStructures) {
        ManylightsSettings own = settings;
        own.structure = structure;
        Frame frame(own);
        ASSERT_TRUE(frame.build({trial.camera.view}, lights_of(trial.spheres))) << frame.failure();
        Outcome found;
        for (const Probe& probe : trial.probes) {
            std::uint64_t before = found.lost;
            check_triple(frame, 0, trial.camera, probe.point, probe.light, found);
            if (found.lost == before) continue;
            oracle::ScreenPosition screen = project(trial.camera, probe.point);
            ADD_FAILURE() << structure_name(structure) << " loses light " << probe.light << " at pixel position ("
                          << screen.x << ", " << screen.y << "), depth " << screen.depth;
            return;
        }
        if (structure != MANYLIGHTS_STRUCTURE_LISTS) continue;
        outcome.triples += found.triples;
        outcome.queries += found.queries;
    }
}

} // namespace manylights::test
