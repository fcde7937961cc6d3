// Depth slices: the formula of the paper's listing 4, its edges, and what lies beyond them.

#include "tests/property/probes.h"

#include <cmath>
#include <limits>
#include <set>

namespace manylights::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

oracle::Camera plain(float guard_px = 0.5f) {
    const float eye[3] = {0.0f, 0.0f, 0.0f};
    return oracle::plain_camera(320, 200, 0.5, eye, guard_px);
}

float steps_from(float value, int steps) {
    for (; steps > 0; --steps) value = std::nextafter(value, kInfinity);
    for (; steps < 0; ++steps) value = std::nextafter(value, 0.0f);
    return value;
}

/// Listing 4 as printed: the log range is multiplied by count - 1 before it is inverted.
int slice_of_listing_4_as_printed(double depth, double near_edge, double far_edge, int count) {
    double scale = 1.0 / ((std::log(far_edge) - std::log(near_edge)) * (count - 1));
    double bias = 1.0 - std::log(near_edge) * scale;
    return static_cast<int>(std::fmin(std::fmax(std::floor(std::log(depth) * scale + bias), 0.0), count - 1.0));
}

TEST(Slices, EverySliceOfTheDefaultGridIsReachedAndMonotoneInDepth) {
    Frame frame(default_settings(MANYLIGHTS_STRUCTURE_LISTS));
    ASSERT_TRUE(frame.build({plain().view}, lights_of({}))) << frame.failure();
    const MlView& view = frame.view();
    ASSERT_EQ(view.slice_count, 16u);
    Buffers buffers = frame.buffers();
    const float* edges = buffers.slice_edges + view.slice_offset;
    EXPECT_EQ(edges[0], 0.0f);
    EXPECT_EQ(edges[16], kInfinity);
    for (int i = 1; i < 16; ++i) ASSERT_NEAR(edges[i], 5.0 * std::pow(100.0, (i - 1) / 15.0), 1e-4 * edges[i]) << i;

    std::set<MlUint> reached;
    std::set<int> reached_as_printed;
    MlUint last = 0;
    for (float depth = 0.1f; depth < 1000.0f; depth *= 1.001f) {
        MlUint slice = buffers.ml_slice(view, depth);
        ASSERT_GE(slice, last) << depth;
        ASSERT_TRUE(edges[slice] <= depth && depth < edges[slice + 1]) << depth;
        // The guess is not needed for correctness, but a wrong one costs a walk over the edges per pixel.
        float guess = std::floor(std::log2(depth) * view.slice_scale + view.slice_bias);
        ASSERT_LE(std::fabs(std::fmin(std::fmax(guess, 0.0f), 15.0f) - static_cast<float>(slice)), 1.0f) << depth;
        last = slice;
        reached.insert(slice);
        reached_as_printed.insert(slice_of_listing_4_as_printed(depth, 5.0, 500.0, 16));
    }
    EXPECT_EQ(reached.size(), 16u);
    EXPECT_LE(reached_as_printed.size(), 2u) << "the printed formula reaches only slices 0 and 1";
}

/// Small lights around depths within 8 units in the last place of each edge, near the axis of view.
Trial lights_beside_every_edge(const ManylightsSettings& settings, std::uint64_t seed) {
    oracle::Random random(seed);
    Trial trial;
    trial.camera = plain();
    Frame frame(settings);
    if (!frame.build({trial.camera.view}, lights_of({}))) return trial;
    for (MlUint i = 1; i < frame.view().slice_count; ++i)
        for (int steps = -8; steps <= 8; ++steps) {
            float depth = steps_from(frame.buffers().slice_edges[i], steps);
            MlFloat3 point = unproject(trial.camera, {random.between(140, 180), random.between(80, 120), depth});
            // Far away a float step is longer than any range: there the light stands on the very point.
            if (depth < 1e12f)
                trial.spheres.push_back(
                    light_reaching(random, trial.camera.eye, point, depth * random.octaves(-20, -16), 0.0));
            else
                trial.add_light(point, 1.0f);
            trial.add_probe(point, static_cast<std::uint32_t>(trial.spheres.size() - 1));
        }
    return trial;
}

/// Two logarithms of different precision: the builder's in double, the shader's in float.
bool logarithms_disagree(double depth, const ManylightsSettings& settings) {
    double scale =
        (settings.slice_count - 1) / std::log2(static_cast<double>(settings.slice_far) / settings.slice_near);
    double bias = 1.0 - std::log2(settings.slice_near) * scale;
    float in_float = std::log2(static_cast<float>(depth)) * static_cast<float>(scale) + static_cast<float>(bias);
    return std::floor(std::log2(depth) * scale + bias) != static_cast<double>(std::floor(in_float));
}

TEST(Slices, LightsThatEndBesideAnEdgeAreFoundOnBothSidesOfIt) {
    ManylightsSettings settings = default_settings(MANYLIGHTS_STRUCTURE_LISTS);
    Outcome outcome;
    NaiveLoss naive;
    // At 1e30 a logarithm in float is wrong by more than the widening of the ranges hides.
    for (float near_edge : {5.0f, 1e-3f, 1e30f})
        for (std::uint32_t count : {2u, 16u, 128u}) {
            settings.slice_near = near_edge;
            settings.slice_far = near_edge * 100.0f;
            settings.slice_count = count;
            Trial trial = lights_beside_every_edge(settings, count);
            expect_none_lost(trial, settings, outcome);
            for (const Probe& probe : trial.probes)
                naive.count(logarithms_disagree(project(trial.camera, probe.point).depth, settings));
        }
    EXPECT_GT(outcome.triples, 3000u);
    EXPECT_GT(naive.lost, 100) << "of " << naive.probes;
}

TEST(Slices, LightsBeyondTheLastEdgeAndBeforeTheFirstAreFound) {
    oracle::Random random(10);
    ManylightsSettings settings = default_settings();
    Trial trial;
    trial.camera = plain();
    NaiveLoss naive;
    for (int i = 0; i < 2000; ++i) {
        double depth = i % 2 == 0 ? 500.0 * random.octaves(0, 6) : random.between(0.101, 5.0);
        MlFloat3 point = unproject(trial.camera, {random.between(0, 320), random.between(0, 200), depth});
        trial.spheres.push_back(light_reaching(random, trial.camera.eye, point, depth * 0.01, 1e-4));
        if (!trial.add_probe(point, static_cast<std::uint32_t>(trial.spheres.size() - 1))) continue;
        // Lights culled at the depth where the slices end, pixels not.
        const ManylightsSphere& light = trial.spheres.back();
        naive.count(depth_space(trial.camera, oracle::camera_relative(light.center, trial.camera.eye)).z - light.range >
                    500.0);
    }
    Outcome outcome;
    expect_none_lost(trial, settings, outcome);
    EXPECT_GT(outcome.triples, 1900u);
    EXPECT_GT(naive.lost, 900) << "of " << naive.probes;
}

} // namespace
} // namespace manylights::test
