// Lights with ranges of zero, without end, or that are no numbers at all.

#include "tests/property/probes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace manylights::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

oracle::Camera plain() {
    const float eye[3] = {0.0f, 0.0f, 0.0f};
    return oracle::plain_camera(100, 80, 0.5, eye, 0.5f);
}

/// Good lights, each with a probe.
Trial good_lights(std::uint64_t seed, int count) {
    oracle::Random random(seed);
    Trial trial;
    trial.camera = plain();
    for (int i = 0; i < count; ++i) {
        oracle::ScreenPosition screen{random.between(0, 100), random.between(0, 80), random.octaves(-2, 9)};
        MlFloat3 point = unproject(trial.camera, screen);
        trial.spheres.push_back(light_reaching(random, trial.camera.eye, point, screen.depth * 0.1, 1e-5));
        trial.add_probe(point, static_cast<std::uint32_t>(i));
    }
    return trial;
}

TEST(UnusualLights, RangeZeroOnTheVeryPointAffectsNothingAndHarmsNoOther) {
    Trial trial = good_lights(18, 200);
    std::size_t good = trial.spheres.size();
    for (const Probe& probe : std::vector<Probe>(trial.probes)) {
        std::uint32_t zero = trial.add_light(probe.point, 0.0f);
        EXPECT_FALSE(trial.add_probe(probe.point, zero));
    }
    Outcome outcome;
    expect_none_lost(trial, default_settings(), outcome);
    EXPECT_GT(outcome.triples, 150u);
    Frame frame(default_settings());
    ASSERT_TRUE(frame.build({trial.camera.view}, lights_of(trial.spheres))) << frame.failure();
    EXPECT_EQ(frame.stats().ignored_lights, 0u) << "range 0 is a good light";
    EXPECT_LE(frame.stats().visible_lights, good);
}

struct BadLight {
    const char* what;
    ManylightsSphere sphere;
};

std::vector<BadLight> bad_lights() {
    std::vector<BadLight> bad;
    for (float value : {kNan, kInfinity, -kInfinity})
        for (int axis = 0; axis < 3; ++axis) {
            BadLight light{"non-finite coordinate", {{0.0f, 0.0f, -2.0f}, 1.0f}};
            light.sphere.center[axis] = value;
            bad.push_back(light);
        }
    bad.push_back({"range NaN", {{0.0f, 0.0f, -2.0f}, kNan}});
    bad.push_back({"range -1", {{0.0f, 0.0f, -2.0f}, -1.0f}});
    bad.push_back({"range -inf", {{0.0f, 0.0f, -2.0f}, -kInfinity}});
    bad.push_back({"all NaN", {{kNan, kNan, kNan}, kNan}});
    return bad;
}

/// Culls written as "drop if": what is no number passes them all.
bool passes_naive_culls(const ManylightsSphere& s) {
    float z = -s.center[2], r = s.range;
    return !(z + r < 0.1f) && !(z - r > 1000.0f);
}

TEST(UnusualLights, NonFiniteAndNegativeOnesAreIgnoredAndCountedAndChangeNoOther) {
    int pass_naive = 0;
    Trial good = good_lights(19, 300);
    for (ManylightsStructure structure : kStructures) {
        Frame plain_frame(default_settings(structure));
        ASSERT_TRUE(plain_frame.build({good.camera.view}, lights_of(good.spheres))) << plain_frame.failure();
        for (const BadLight& bad : bad_lights()) {
            pass_naive += passes_naive_culls(bad.sphere) ? 1 : 0;
            Frame alone(default_settings(structure));
            ASSERT_TRUE(alone.build({good.camera.view}, lights_of({bad.sphere}))) << bad.what;
            EXPECT_EQ(alone.reference_count(), 0u) << bad.what;
            EXPECT_EQ(alone.stats().ignored_lights, 1u) << bad.what;
            EXPECT_EQ(alone.stats().visible_lights, 0u) << bad.what;

            // Behind the good lights their indices stay; so must every byte.
            std::vector<ManylightsSphere> mixed = good.spheres;
            mixed.push_back(bad.sphere);
            Frame frame(default_settings(structure));
            ASSERT_TRUE(frame.build({good.camera.view}, lights_of(mixed))) << bad.what;
            EXPECT_TRUE(frame.bytes() == plain_frame.bytes()) << bad.what;
            EXPECT_EQ(frame.stats().ignored_lights, 1u) << bad.what;
            EXPECT_EQ(frame.stats().first_ignored, 300u) << bad.what;
        }
    }
    EXPECT_GT(pass_naive, 10) << "culls of the form `drop if` must let these through";
}

TEST(UnusualLights, HugeRangesReachEveryPixel) {
    for (float range : {1e6f, 1e18f, 1e30f, std::numeric_limits<float>::max(), kInfinity}) {
        Trial trial;
        trial.camera = plain();
        oracle::Random random(20);
        for (MlFloat3 center : {MlFloat3{0, 0, 0}, MlFloat3{1e3f, -1e3f, 1e3f}, MlFloat3{0, 0, -5e5f}})
            trial.add_light(center, range);
        for (int y = 0; y < 80; y += 7)
            for (int x = 0; x < 100; x += 7)
                for (std::uint32_t light = 0; light < 3; ++light)
                    trial.add_probe(unproject(trial.camera, {x + 0.5, y + 0.5, random.octaves(-3, 15)}), light);
        EXPECT_GT(trial.probes.size(), 500u);
        Outcome outcome;
        expect_none_lost(trial, default_settings(), outcome);
        EXPECT_EQ(outcome.triples, trial.probes.size()) << range;
    }
}

/// Screen bounds by tangents in float: d^2 - r^2 cancels, or is negative under the root.
bool lost_by_float_tangents(oracle::Double3 c, float r, double slope) {
    float x = static_cast<float>(c.x), z = static_cast<float>(c.z);
    float t = std::sqrt(x * x + z * z - r * r);
    float low = (x * t - z * r) / (z * t + x * r), high = (x * t + z * r) / (z * t - x * r);
    return !(low <= slope && slope <= high);
}

TEST(UnusualLights, SurfacesOfHugeSpheresThatCutTheViewLoseNothing) {
    oracle::Random random(21);
    Trial trial;
    trial.camera = plain();
    NaiveLoss naive;
    for (int i = 0; i < 3000; ++i) {
        oracle::ScreenPosition screen{random.between(0, 100), random.between(0, 80), random.octaves(-2, 9)};
        MlFloat3 point = unproject(trial.camera, screen);
        double distance = std::ldexp(1.0 + random.unit(), random.integer(8, 58));
        trial.spheres.push_back(light_reaching(random, trial.camera.eye, point, distance, 0.0));
        std::uint32_t light = static_cast<std::uint32_t>(i);
        if (!trial.add_probe(point, light)) continue;
        const ManylightsSphere& s = trial.spheres.back();
        oracle::Double3 p = depth_space(trial.camera, point);
        naive.count(lost_by_float_tangents(depth_space(trial.camera, {s.center[0], s.center[1], s.center[2]}), s.range,
                                           p.x / p.z));
    }
    Outcome outcome;
    expect_none_lost(trial, default_settings(), outcome);
    EXPECT_GT(outcome.triples, 2500u);
    EXPECT_GT(naive.lost, naive.probes / 4) << "of " << naive.probes;
}

} // namespace
} // namespace manylights::test
