// Depth ranges: how tight they are far away, how they round, and what the depth buffer does to a depth.

#include "tests/property/probes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace manylights::test {
namespace {

/// Half precision has 11 significant bits: the value rounded outward to a multiple of 2^(exponent - 10).
double half_down(double value) {
    double step = std::ldexp(1.0, std::ilogb(value) - 10);
    return std::floor(value / step) * step;
}
double half_up(double value) {
    double step = std::ldexp(1.0, std::ilogb(value) - 10);
    return std::ceil(value / step) * step;
}

TEST(DepthRanges, TinyLightsFarAwayKeepTightRanges) {
    oracle::Random random(4);
    const float eye[3] = {0.0f, 0.0f, 0.0f};
    oracle::Camera camera = oracle::plain_camera(64, 64, 0.01, eye, 0.5f);
    std::vector<ManylightsSphere> spheres;
    for (int i = 0; i < 4000; ++i) {
        MlFloat3 p = unproject(camera, {random.between(1, 63), random.between(1, 63), random.between(50.0, 4000.0)});
        spheres.push_back({{p.x, p.y, p.z}, 0.05f});
    }
    ManylightsSettings settings = default_settings(MANYLIGHTS_STRUCTURE_TREES);
    settings.leaf_size = 1;
    Frame frame(settings);
    ASSERT_TRUE(frame.build({camera.view}, lights_of(spheres))) << frame.failure();
    double worst = 0.0, sum = 0.0, sum_of_halves = 0.0;
    int leaves = 0;
    for (std::size_t i = 0; i < frame.node_count(); ++i) {
        const MlNode& node = frame.buffers().nodes[i];
        if (!ml_node_is_leaf(node.bits) || ml_node_light_count(node.bits) != 1) continue;
        double width = static_cast<double>(node.max_depth) - node.min_depth;
        worst = std::max(worst, width / 0.1);
        sum += width / 0.1;
        sum_of_halves += (half_up(node.max_depth) - half_down(node.min_depth)) / 0.1;
        ++leaves;
    }
    ASSERT_GT(leaves, 3000);
    EXPECT_LT(worst, 1.5);
    EXPECT_LT(sum / leaves, 1.25);
    EXPECT_GT(sum_of_halves / leaves, 5.0) << "half precision must widen the ranges of these very lights much more";
}

/// The greatest depth of a sphere inside of the half space x <= slope * depth, when its centre is outside: the rim of
/// the cap. In float, without slack: the naive form.
struct Cap {
    double low, high;
};
template <typename Real>
Cap cap_depths(Real x, Real z, Real r, Real slope) {
    Real n = std::sqrt(Real(1) + slope * slope);
    Real distance = (x - slope * z) / n;
    Real foot = z + distance * slope / n;
    Real rim = std::sqrt(std::max(r * r - distance * distance, Real(0)));
    return {static_cast<double>(foot - rim / n), static_cast<double>(foot + rim / n)};
}

TEST(DepthRanges, RangesInsideATileAreNotTooSmallWhereTheSphereBarelyTouchesIt) {
    Outcome outcome;
    NaiveLoss naive;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        oracle::Random random(seed);
        Trial trial;
        trial.camera = camera_at_origin(random, 400);
        if (trial.camera.view.width < 16) continue;
        for (int i = 0; i < 200; ++i) {
            double edge = 8.0 * (1 + random.below((trial.camera.view.width - 1) / 8));
            oracle::Double3 slope = slopes_at(trial.camera, edge, random.between(0, trial.camera.view.height));
            double depth = trial.camera.near_depth * random.octaves(1, 6), r = depth * random.octaves(-6, -2);
            // The centre lies outside of the plane through the edge, nearly as far as r; in the plane x = slope * z the
            // disc's rim has its extreme depths where the line through the foot runs along the plane.
            double n = std::sqrt(1.0 + slope.x * slope.x), distance = r * (1.0 - random.octaves(-20, -2));
            oracle::Double3 foot{slope.x * depth, slope.y * depth, depth};
            oracle::Double3 c = foot + oracle::Double3{1.0, 0.0, -slope.x} * (distance / n);
            MlFloat3 center = relative_at(trial.camera, c.x, c.y, c.z);
            std::uint32_t light = trial.add_light(center, static_cast<float>(r));
            oracle::Double3 exact = depth_space(trial.camera, center);
            Cap wanted = cap_depths(exact.x, exact.z, static_cast<double>(static_cast<float>(r)), slope.x);
            Cap in_float = cap_depths(static_cast<float>(exact.x), static_cast<float>(exact.z), static_cast<float>(r),
                                      static_cast<float>(slope.x));
            naive.count(in_float.low > wanted.low || in_float.high < wanted.high);
            for (double z : {wanted.low, wanted.high}) {
                oracle::Double3 rim{slope.x * z, exact.y, z};
                oracle::Double3 inward = exact + (rim - exact) * (1.0 - 1e-7);
                trial.add_probe(relative_at(trial.camera, inward.x, inward.y, inward.z), light);
            }
        }
        ManylightsSettings settings = default_settings();
        settings.tile_px = 8;
        settings.leaf_size = 1;
        expect_none_lost(trial, settings, outcome);
    }
    EXPECT_GT(outcome.triples, 3000u);
    EXPECT_GT(naive.lost, naive.probes / 10) << "float without slack must be too small for many of " << naive.probes;
}

/// What a shader gets back from the depth buffer, all in float: clip z / w as the rasteriser stores it, then inverted.
float reconstructed_depth(const oracle::Camera& camera, double depth) {
    const float* m = camera.view.clip_from_view;
    float view_z = static_cast<float>(m[11] < 0.0f ? -depth : depth);
    float stored = (m[10] * view_z + m[14]) / (m[11] * view_z);
    return m[14] / (stored * std::fabs(m[11]) - m[10] * (m[11] < 0.0f ? -1.0f : 1.0f));
}

TEST(DepthRanges, DepthsReadBackFromTheDepthBufferFindTheirLights) {
    Outcome outcome;
    NaiveLoss naive;
    double worst_reversed = 0.0, worst_standard = 0.0;
    int conventions[2] = {};
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        oracle::Random random(seed);
        Trial trial;
        trial.camera = camera_at_origin(random);
        bool reversed = trial.camera.view.clip_from_view[14] > 0.0f;
        for (int i = 0; i < 100; ++i) {
            oracle::ScreenPosition screen{random.between(0, trial.camera.view.width),
                                          random.between(0, trial.camera.view.height),
                                          trial.camera.near_depth * random.octaves(0, 15)};
            if (screen.depth > trial.camera.far_depth) continue;
            double drawn = screen.depth;
            screen.depth = reconstructed_depth(trial.camera, drawn);
            if (!(screen.depth > 0.0 && screen.depth < 1e30)) continue;
            double& worst = reversed ? worst_reversed : worst_standard;
            worst = std::max(worst, std::fabs(screen.depth - drawn) / drawn);
            // The shading point is rebuilt from the depth that was read, and the light reaches only just there.
            MlFloat3 point = unproject(trial.camera, screen);
            trial.spheres.push_back(
                light_reaching(random, trial.camera.eye, point, screen.depth * random.octaves(-14, -6), 0.0));
            std::uint32_t light = static_cast<std::uint32_t>(trial.spheres.size() - 1);
            if (!trial.add_probe(point, light)) continue;
            ++conventions[reversed ? 1 : 0];
            // Asking at the depth that was drawn instead of the one that was read.
            oracle::Double3 c =
                depth_space(trial.camera, oracle::camera_relative(trial.spheres[light].center, trial.camera.eye));
            naive.count(std::fabs(drawn - c.z) > trial.spheres[light].range * (1.0 + 1e-6));
        }
        expect_none_lost(trial, default_settings(), outcome);
    }
    EXPECT_GT(outcome.triples, 5000u);
    EXPECT_GT(conventions[0], 1000);
    EXPECT_GT(conventions[1], 1000);
    EXPECT_LT(worst_reversed, std::ldexp(1.0, -20)) << "reversed depth is exact enough for any range of depths";
    EXPECT_GT(worst_standard, 1e-4) << "standard depth is not: point and query must use the depth that was read";
    EXPECT_GT(naive.lost, 20) << "of " << naive.probes;
}

TEST(DepthRanges, PointsThatFloatClippingKeepsBeyondTheFarPlaneFindTheirLights) {
    Outcome outcome;
    double farthest = 0.0;
    const float eye[3] = {0.0f, 0.0f, 0.0f};
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        oracle::Random random(seed);
        Trial trial;
        trial.camera = oracle::plain_camera(100, 100, 0.5, eye, 0.5f);
        // Standard depth: clip z = slope * depth - near * slope, with slope = far / (far - near) within an ulp of 1.
        double near_depth = 0.1, far_depth = near_depth * random.between(1e4, 9e4);
        float* m = trial.camera.view.clip_from_view;
        float slope = static_cast<float>(far_depth / (far_depth - near_depth));
        m[10] = -slope;
        m[14] = static_cast<float>(-near_depth * slope);
        trial.camera.near_depth = near_depth * 1.001;
        trial.camera.far_depth = m[14] / (1.0 - slope);
        for (int i = 0; i < 200; ++i) {
            oracle::ScreenPosition screen{random.between(0, 100), random.between(0, 100),
                                          trial.camera.far_depth * (1.0 + random.octaves(-14, -7))};
            MlFloat3 point = unproject(trial.camera, screen);
            trial.spheres.push_back(light_reaching(random, eye, point, screen.depth * 1e-5, 1e-5));
            if (trial.add_probe(point, static_cast<std::uint32_t>(i)))
                farthest = std::max(farthest, screen.depth / trial.camera.far_depth);
        }
        expect_none_lost(trial, default_settings(), outcome);
    }
    EXPECT_GT(outcome.triples, 1000u);
    EXPECT_GT(farthest, 1.002) << "float clip z must keep points well beyond the far plane";
}

TEST(DepthRanges, ThePolesOfSpheresAreFoundAcrossTheWholeDepthTolerance) {
    Outcome outcome;
    int accepted_outside = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        oracle::Random random(seed);
        Trial trial;
        trial.camera = camera_at_origin(random, 200);
        for (int i = 0; i < 200; ++i) {
            // The deepest or the nearest point of a sphere, which the float predicate only just accepts. Where the
            // centre is close to the camera, the widening by the centre's distance is of no help.
            double depth = trial.camera.near_depth * random.octaves(0, 8);
            double radius = depth * random.octaves(-4, 0);
            MlFloat3 point =
                relative_at(trial.camera, depth * random.between(-0.1, 0.1), depth * random.between(-0.1, 0.1), depth);
            oracle::Double3 p = depth_space(trial.camera, point);
            double pole = random.chance(0.7) ? -1.0 : 1.0;
            MlFloat3 center = relative_at(trial.camera, p.x, p.y, p.z + pole * (random.chance(0.5) ? radius : depth));
            std::uint32_t light = trial.add_light(center, oracle::least_range(point, center));
            if (!trial.add_probe(point, light)) continue;
            accepted_outside +=
                oracle::distance_to_surface(point, {center, trial.spheres[light].range, light}) > 0.0 ? 1 : 0;
        }
        ManylightsSettings settings = default_settings();
        settings.leaf_size = 1;
        expect_none_lost(trial, settings, outcome);
    }
    EXPECT_GT(outcome.triples, 5000u);
    EXPECT_GT(accepted_outside, 200);
}

TEST(DepthRanges, LightsBehindTheCameraSortBeforeThoseInFront) {
    oracle::Random random(17);
    const float eye[3] = {0.0f, 0.0f, 0.0f};
    Trial trial;
    trial.camera = oracle::plain_camera(16, 16, 0.5, eye, 0.5f);
    for (int i = 0; i < 64; ++i) {
        double behind = random.between(1.0, 50.0);
        bool is_behind = i % 2 == 0;
        MlFloat3 center{0.0f, 0.0f, static_cast<float>(is_behind ? behind : -behind)};
        std::uint32_t light = trial.add_light(center, is_behind ? static_cast<float>(behind + 2.0) : 0.25f);
        trial.add_probe(is_behind ? MlFloat3{0.01f, 0.01f, -1.5f} : center, light);
    }
    Outcome outcome;
    ManylightsSettings settings = default_settings(MANYLIGHTS_STRUCTURE_TREES);
    settings.leaf_size = 1;
    expect_none_lost(trial, settings, outcome);
    EXPECT_GE(outcome.triples, 60u);

    Frame frame(settings);
    ASSERT_TRUE(frame.build({trial.camera.view}, lights_of(trial.spheres))) << frame.failure();
    ASSERT_EQ(frame.reference_count(), 64u);
    // Those behind the camera in any order.
    float deepest = -1.0f;
    for (std::size_t i = 0; i < frame.reference_count(); ++i) {
        float depth = -trial.spheres[frame.buffers().references[i]].center[2];
        if (depth < 0.0f) {
            ASSERT_LT(i, 32u) << "sorted by the raw bits of the depth they would come last";
            continue;
        }
        // A band is a 64th of the depths in front, at most 50 apart, or less.
        ASSERT_GE(depth, deepest - 50.0f / 63.0f) << "in order of depth, but for a band's";
        deepest = std::max(deepest, depth);
    }
    // Behind and in front mixed would make every node on the way down wide: a deep query then reads the whole tree.
    MlView view = frame.view();
    EXPECT_LT(frame.query(0, 8, 8, 60.0f).size(), 1u);
    EXPECT_EQ(view.tiles_x, 1u);
}

TEST(DepthRanges, NodesContainTheirLightsRoundedOutward) {
    oracle::Random random(3);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        oracle::Camera camera = camera_at_origin(random, 200);
        std::vector<ManylightsSphere> spheres;
        for (int i = 0; i < 200; ++i) {
            MlFloat3 p = unproject(camera, {random.between(0, camera.view.width), random.between(0, camera.view.height),
                                            random.octaves(-30, 60)});
            spheres.push_back({{p.x, p.y, p.z}, static_cast<float>(random.octaves(-30, 58))});
        }
        Frame frame(default_settings(MANYLIGHTS_STRUCTURE_TREES));
        ASSERT_TRUE(frame.build({camera.view}, lights_of(spheres))) << frame.failure();
        for (std::size_t i = 0; i < frame.node_count(); ++i) {
            const MlNode& node = frame.buffers().nodes[i];
            for (MlUint k = 0; ml_node_is_leaf(node.bits) && k < ml_node_light_count(node.bits); ++k) {
                const ManylightsSphere& s = spheres[frame.buffers().references[node.first + k]];
                double depth = depth_space(camera, {s.center[0], s.center[1], s.center[2]}).z;
                ASSERT_LE(node.min_depth, depth - s.range);
                ASSERT_GE(node.max_depth, std::min<double>(depth + s.range, std::numeric_limits<float>::max()));
            }
        }
    }
}

} // namespace
} // namespace manylights::test
