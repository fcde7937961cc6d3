// The promise of manylights.h over random cameras, lights and points: at least 10^6 triples (light, camera, point) in
// which the light affects the point; 10^7 with MANYLIGHTS_FULL set. At least a quarter of them within 1e-4 of the range
// from the light's surface, and a quarter within 4 units in the last place of a tile's or a slice's edge.

#include "tests/property/edge_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace manylights::test {
namespace {

constexpr int kLightsPerPlan = 400;

struct Tally {
    std::uint64_t triples = 0, at_surface = 0, at_edge = 0, both = 0, far_from_origin = 0;
    std::uint64_t plans = 0, queries = 0;
    std::uint64_t lost[5] = {}; ///< by structure
};

ManylightsSettings random_settings(oracle::Random& random) {
    static constexpr std::uint32_t kTiles[] = {8, 13, 16, 32, 48, 64, 100, 4096};
    static constexpr std::uint32_t kSlices[] = {1, 2, 16, 16, 33, 128};
    static constexpr std::uint32_t kLeaves[] = {1, 3, 4, 6, 100};
    ManylightsSettings settings = default_settings();
    settings.tile_px = kTiles[random.below(8)];
    settings.slice_count = kSlices[random.below(6)];
    settings.leaf_size = kLeaves[random.below(5)];
    settings.slice_near = static_cast<float>(random.octaves(-5, 3));
    settings.slice_far = settings.slice_near * static_cast<float>(random.octaves(1, 10));
    return settings;
}

/// One to three cameras at one place.
std::vector<oracle::Camera> random_cameras(oracle::Random& random, std::uint32_t tile_px) {
    oracle::CameraOptions options;
    options.largest_edge_px = tile_px < 16 ? 600 : 2000;
    std::vector<oracle::Camera> cameras{random_camera(random, options)};
    while (cameras.size() < 3 && random.chance(0.3))
        cameras.push_back(random_camera_at(random, cameras[0].eye, options));
    // A guard of many tiles would spend the test's time on few points.
    for (oracle::Camera& camera : cameras)
        camera.view.guard_px = std::fmin(camera.view.guard_px, static_cast<float>(tile_px));
    return cameras;
}

struct Case {
    std::size_t view;
    EdgePoint anchor;
};

Case random_case(oracle::Random& random, const std::vector<oracle::Camera>& cameras, const Grid& grid) {
    std::size_t view = random.below(static_cast<std::uint32_t>(cameras.size()));
    double kind = random.unit();
    if (kind < 0.35) return {view, point_at_slice_edge(random, cameras[view], grid)};
    if (kind < 0.7) return {view, point_at_tile_edge(random, cameras[view], grid)};
    return {view, point_anywhere(random, cameras[view])};
}

ManylightsSphere random_light(oracle::Random& random, const float eye[3], MlFloat3 point, bool may_be_huge) {
    double distance = length(oracle::to_double(point)) * random.octaves(-10, may_be_huge ? 3 : -5);
    double kind = random.unit();
    double excess = kind < 0.2 ? 0.0 : (kind < 0.85 ? 9e-5 * random.unit() : 2.0 * random.unit());
    return light_reaching(random, eye, point, distance, excess);
}

void tally_point(const oracle::Camera& camera, const Grid& grid, MlFloat3 point,
                 const std::vector<oracle::RelativeLight>& lights, const std::vector<std::uint32_t>& affecting,
                 Tally& tally) {
    bool edge = is_at_edge(camera, grid, point);
    for (std::uint32_t index : affecting) {
        bool surface = std::fabs(distance_to_surface(point, lights[index])) <= 1e-4 * lights[index].range;
        tally.triples += 1;
        tally.at_edge += edge ? 1 : 0;
        tally.at_surface += surface ? 1 : 0;
        tally.both += edge && surface ? 1 : 0;
        tally.far_from_origin += std::fabs(camera.eye[0]) > 1e4f ? 1 : 0;
    }
}

/// One plan per structure over the same lights and cameras.
void run_case(oracle::Random& random, Tally& tally) {
    ManylightsSettings settings = random_settings(random);
    std::vector<oracle::Camera> cameras = random_cameras(random, settings.tile_px);
    Grid grid = grid_of(settings, cameras[0].view);
    ASSERT_GT(grid.tile_px, 0u);
    std::vector<Case> cases;
    std::vector<ManylightsSphere> spheres;
    bool may_be_huge = random.chance(0.03);
    for (int i = 0; i < kLightsPerPlan; ++i) {
        cases.push_back(random_case(random, cameras, grid));
        spheres.push_back(random_light(random, cameras[0].eye, cases.back().anchor.point, may_be_huge));
    }
    std::vector<ManylightsView> views;
    for (const oracle::Camera& camera : cameras) views.push_back(camera.view);
    std::vector<std::unique_ptr<Frame>> frames;
    for (ManylightsStructure structure : kStructures) {
        settings.structure = structure;
        frames.push_back(std::make_unique<Frame>(settings));
        ASSERT_TRUE(frames.back()->build(views, lights_of(spheres))) << frames.back()->failure();
        ++tally.plans;
    }
    std::vector<oracle::RelativeLight> lights = oracle::relative_lights(lights_of(spheres), cameras[0].eye);
    ASSERT_EQ(lights.size(), spheres.size());
    for (const Case& c : cases) {
        std::vector<std::uint32_t> affecting = affecting_lights(c.anchor.point, lights).indices;
        std::uint64_t checked = 0;
        for (const std::unique_ptr<Frame>& frame : frames) {
            Outcome outcome;
            check_point(*frame, c.view, cameras[c.view], c.anchor.point, affecting, outcome, c.anchor.query_depths);
            checked = outcome.triples;
            tally.queries += outcome.queries;
            tally.lost[frame->view().structure] += outcome.lost;
        }
        if (checked > 0) tally_point(cameras[c.view], grid, c.anchor.point, lights, affecting, tally);
    }
}

TEST(Promise, EveryAffectingLightIsHandedOutExactlyOnce) {
    const char* full = std::getenv("MANYLIGHTS_FULL");
    const std::uint64_t wanted = full != nullptr && *full != '0' ? 10'000'000 : 1'000'000;
    Tally tally;
    std::uint64_t seed = 1;
    for (; tally.triples < wanted && tally.plans < wanted; ++seed) {
        oracle::Random random(seed);
        run_case(random, tally);
        ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
        ASSERT_EQ(tally.lost[1] + tally.lost[2] + tally.lost[3] + tally.lost[4], 0u)
            << "seed " << seed << ": lists lost " << tally.lost[1] << ", trees " << tally.lost[2] << ", hybrid "
            << tally.lost[3] << ", windows " << tally.lost[4];
    }
    std::printf("triples %llu: at the surface %llu, at an edge %llu, both %llu, "
                "1e4 and more from the origin %llu; plans %llu, queries %llu\n",
                static_cast<unsigned long long>(tally.triples), static_cast<unsigned long long>(tally.at_surface),
                static_cast<unsigned long long>(tally.at_edge), static_cast<unsigned long long>(tally.both),
                static_cast<unsigned long long>(tally.far_from_origin), static_cast<unsigned long long>(tally.plans),
                static_cast<unsigned long long>(tally.queries));
    EXPECT_GE(tally.triples, wanted);
    EXPECT_GE(tally.at_surface * 4, tally.triples);
    EXPECT_GE(tally.at_edge * 4, tally.triples);
    EXPECT_GT(tally.both, wanted / 100);
    EXPECT_GT(tally.far_from_origin, wanted / 100);
}

} // namespace
} // namespace manylights::test
