// Depth windows: where depth codes saturate, where they meet, and where all of them are one.

#include "tests/property/probes.h"

#include <cmath>

namespace manylights::test {
namespace {

/// A light around a point of the image, and the point as its probe.
bool add_at(Trial& trial, oracle::Random& random, double depth, double range) {
    MlFloat3 point = unproject(
        trial.camera, {random.between(0, trial.camera.view.width), random.between(0, trial.camera.view.height), depth});
    trial.spheres.push_back(light_reaching(random, trial.camera.eye, point, range, 1e-5));
    return trial.add_probe(point, static_cast<std::uint32_t>(trial.spheres.size() - 1));
}

oracle::Camera plain() {
    const float eye[3] = {0.0f, 0.0f, 0.0f};
    return oracle::plain_camera(200, 120, 0.5, eye, 0.5f);
}

/// How many probes lie where the depth code is the last one.
int saturated_probes(const Trial& trial) {
    Frame frame(default_settings(MANYLIGHTS_STRUCTURE_WINDOWS));
    EXPECT_TRUE(frame.build({trial.camera.view}, lights_of(trial.spheres))) << frame.failure();
    int saturated = 0;
    for (const Probe& probe : trial.probes) {
        auto depth = static_cast<float>(project(trial.camera, probe.point).depth);
        saturated += ml_depth_code(depth, frame.view().depth_scale) == ML_DEPTH_CODE_MAX ? 1 : 0;
    }
    return saturated;
}

TEST(Windows, LightsBeyondTheLastDepthCodeAreStillFound) {
    Outcome outcome;
    int saturated = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        oracle::Random random(seed);
        Trial trial;
        trial.camera = plain();
        for (int i = 0; i < 5000; ++i) add_at(trial, random, random.between(2, 8), 0.05);
        trial.probes.resize(100);
        for (int i = 0; i < 4; ++i) add_at(trial, random, 500.0 * random.octaves(0, 20), 20.0);
        // What reaches everything: a probe for it at depths that no other light comes near.
        std::uint32_t everywhere = trial.add_light({10.0f, 20.0f, 30.0f}, 1e18f);
        for (int i = 0; i < 50; ++i) {
            double depth = 0.6 * random.octaves(0, 30);
            trial.add_probe(unproject(trial.camera, {random.between(0, 200), random.between(0, 120), depth}),
                            everywhere);
        }
        saturated += saturated_probes(trial);
        expect_none_lost(trial, default_settings(), outcome);
    }
    EXPECT_GT(outcome.triples, 1000u);
    EXPECT_GT(saturated, 100) << "many of the probes must lie beyond the last code of its own";
}

TEST(Windows, PointsAtTenTimesTheGreatestDepthFindNoLightAndHarmNone) {
    Trial trial;
    oracle::Random random(3);
    trial.camera = plain();
    for (int i = 0; i < 1000; ++i) add_at(trial, random, random.between(2, 60), 5.0);
    Frame frame(default_settings(MANYLIGHTS_STRUCTURE_WINDOWS));
    ASSERT_TRUE(frame.build({trial.camera.view}, lights_of(trial.spheres))) << frame.failure();
    for (float depth : {700.0f, 7e4f, 1e30f, INFINITY, 0.0f, -1.0f, -INFINITY, NAN})
        for (float x = 0.5f; x < 200.0f; x += 9.0f)
            EXPECT_TRUE(frame.query(0, x, 60.5f, depth).empty()) << depth << " at " << x;
}

TEST(Windows, NearAndFarPolesOnEdgesOfDepthCodesAreHeld) {
    Outcome outcome;
    int at_edge = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        oracle::Random random(seed);
        Trial trial;
        trial.camera = plain();
        for (int i = 0; i < 600; ++i) {
            // Nearly on the axis of view, so that the poles are in the light's own tile; depths are codes of a coarse
            // scale, which are codes of every finer one.
            float depth = 0.125f * static_cast<float>(80 + random.below(4000));
            float range = 0.125f * static_cast<float>(1 + random.below(64));
            std::uint32_t light = trial.add_light({0.0f, 0.0f, -depth}, range);
            for (float pole : {std::nextafter(depth - range, depth), std::nextafter(depth + range, depth)}) {
                if (!trial.add_probe({0.0f, 0.0f, -pole}, light)) continue;
                at_edge += std::fabs(pole * 8.0f - std::round(pole * 8.0f)) < 1e-3f ? 1 : 0;
            }
        }
        ManylightsSettings settings = default_settings();
        settings.tile_px = seed % 2 == 0 ? 8 : 0;
        expect_none_lost(trial, settings, outcome);
    }
    EXPECT_GT(outcome.triples, 5000u);
    EXPECT_GT(at_edge, 5000);
}

TEST(Windows, AllLightsAtOnePointAreAllHandedOut) {
    for (std::uint32_t count : {1u, 8u, 9u, 127u, 128u, 70000u}) {
        Trial trial;
        trial.camera = plain();
        for (std::uint32_t i = 0; i < count; ++i) trial.add_light({0.1f, 0.1f, -5.0f}, 1.0f);
        ManylightsSettings settings = default_settings(MANYLIGHTS_STRUCTURE_WINDOWS);
        for (std::uint32_t tile_px : {0u, 8u, 13u, 4096u}) {
            settings.tile_px = tile_px;
            if (count > 1000 && tile_px == 8) continue;
            Frame frame(settings);
            ASSERT_TRUE(frame.build({trial.camera.view}, lights_of(trial.spheres))) << frame.failure();
            oracle::ScreenPosition screen = project(trial.camera, {0.1f, 0.1f, -5.0f});
            for (float depth : {4.001f, 5.0f, 5.999f})
                EXPECT_EQ(frame.query(0, static_cast<float>(screen.x), static_cast<float>(screen.y), depth).size(),
                          count);
        }
    }
}

} // namespace
} // namespace manylights::test
