// Far from the world's origin, and one decision for counting and filling.

#include "tests/property/probes.h"

#include <cmath>

namespace manylights::test {
namespace {

/// The light's centre in view space by the whole matrix in float.
MlFloat3 view_from_world_in_float(const oracle::Camera& camera, const float p[3]) {
    const float* m = camera.view.view_from_world;
    float v[3];
    for (int i = 0; i < 3; ++i) v[i] = m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i];
    return {v[0], v[1], v[2]};
}

/// A camera about 1e5 from the origin, and lights that reach points near it only just.
Trial far_from_the_origin(std::uint64_t seed, NaiveLoss& naive) {
    oracle::Random random(seed);
    Trial trial;
    float eye[3];
    for (float& coordinate : eye) coordinate = static_cast<float>(random.sign() * random.between(5e4, 1e5));
    trial.camera = random_camera_at(random, eye);
    trial.camera.view.guard_px = 0.5f;
    for (int i = 0; i < 300; ++i) {
        oracle::ScreenPosition screen{random.between(0, trial.camera.view.width),
                                      random.between(0, trial.camera.view.height),
                                      trial.camera.near_depth * random.octaves(0, 6)};
        MlFloat3 point = unproject(trial.camera, screen);
        trial.spheres.push_back(light_reaching(random, eye, point, screen.depth * random.octaves(-8, -1), 0.0));
        if (!trial.add_probe(point, static_cast<std::uint32_t>(i))) continue;
        // The point lies within the range of the centre as the oracle sees it, not as the float transform does.
        MlFloat3 c = view_from_world_in_float(trial.camera, trial.spheres.back().center);
        oracle::Double3 p = view_from_relative(trial.camera, oracle::to_double(point));
        naive.count(length(p - oracle::to_double(c)) > trial.spheres.back().range * (1.0 + 1e-5));
    }
    return trial;
}

TEST(Precision, FarFromTheOriginNoLightIsLostForCameraRelativePoints) {
    Outcome outcome;
    NaiveLoss naive;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
        expect_none_lost(far_from_the_origin(seed, naive), default_settings(), outcome);
    EXPECT_GT(outcome.triples, 10000u);
    EXPECT_GT(naive.lost, naive.probes / 10) << "world to view in float must misplace many of " << naive.probes;
}

/// A point on the surface of each light as a renderer sees it that shades in world space: rounded there, and the
/// distance too. The ranges are made to fit: each light reaches its point only just.
std::vector<MlFloat3> world_points_on_surfaces(oracle::Random& random, std::vector<ManylightsSphere>& spheres) {
    std::vector<MlFloat3> points;
    for (ManylightsSphere& s : spheres) {
        MlFloat3 center{s.center[0], s.center[1], s.center[2]};
        points.push_back(oracle::to_float(oracle::to_double(center) + random.direction() * s.range));
        s.range = oracle::least_range(points.back(), center);
    }
    return points;
}

/// Where such a renderer sees the point follows from the whole matrix, whose translation is rounded at the size of the
/// world.
oracle::ScreenPosition project_from_world(const oracle::Camera& camera, MlFloat3 point) {
    const float world[3] = {point.x, point.y, point.z};
    return project_view_space(camera, view_from_world(camera, world));
}

TEST(Precision, FarFromTheOriginNoLightIsLostForPointsInWorldSpace) {
    int queries = 0, moved = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        NaiveLoss unused;
        Trial trial = far_from_the_origin(seed, unused);
        oracle::Random random(seed + 1000);
        std::vector<MlFloat3> points = world_points_on_surfaces(random, trial.spheres);
        for (ManylightsStructure structure : kStructures) {
            Frame frame(default_settings(structure));
            ASSERT_TRUE(frame.build({trial.camera.view}, lights_of(trial.spheres))) << frame.failure();
            for (std::uint32_t i = 0; i < points.size(); ++i) {
                oracle::ScreenPosition screen = project_from_world(trial.camera, points[i]);
                if (!is_between_planes(trial.camera, screen)) continue;
                for (MlFloat2 pixel : promised_pixels(trial.camera, frame.view().tile_px, screen))
                    for (float depth : promised_depths(screen.depth)) {
                        ASSERT_EQ(frame.times_handed_out(0, pixel.x, pixel.y, depth, i), 1)
                            << structure_name(structure) << " seed " << seed << " light " << i;
                        ++queries;
                    }
                const float world[3] = {points[i].x, points[i].y, points[i].z};
                double relative_depth = project(trial.camera, oracle::camera_relative(world, trial.camera.eye)).depth;
                moved += is_promised_depth(static_cast<float>(relative_depth), screen.depth) ? 0 : 1;
            }
        }
    }
    EXPECT_GT(queries, 10000);
    EXPECT_GT(moved, 1000) << "the translation's rounding must move these points by more than the promise allows";
}

TEST(Precision, LightsThatMoveByTheMotionMarginAreStillFound) {
    Outcome outcome;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        oracle::Random random(seed);
        Trial trial;
        trial.camera = camera_at_origin(random);
        for (int i = 0; i < 100; ++i) {
            MlFloat3 point = unproject(trial.camera, {random.between(0, trial.camera.view.width),
                                                      random.between(0, trial.camera.view.height),
                                                      trial.camera.near_depth * random.octaves(0, 6)});
            trial.spheres.push_back(light_reaching(random, trial.camera.eye, point, 1.0, 1e-5));
            trial.add_probe(point, static_cast<std::uint32_t>(i));
        }
        std::vector<ManylightsSphere> planned = trial.spheres;
        for (ManylightsSphere& s : planned) {
            oracle::Double3 step = random.direction() * 0.25;
            s.center[0] += static_cast<float>(step.x);
            s.center[1] += static_cast<float>(step.y);
            s.center[2] += static_cast<float>(step.z);
        }
        ManylightsLights lights = lights_of(planned);
        lights.motion_margin = 0.2501f;
        Frame frame(default_settings());
        ASSERT_TRUE(frame.build({trial.camera.view}, lights)) << frame.failure();
        for (const Probe& probe : trial.probes) check_triple(frame, 0, trial.camera, probe.point, probe.light, outcome);
    }
    EXPECT_GT(outcome.triples, 1000u);
    EXPECT_EQ(outcome.lost, 0u);
}

/// Overlapping lights of all sizes, many of them on the edges of tiles.
std::vector<ManylightsSphere> crowd(oracle::Random& random, const oracle::Camera& camera, int count) {
    std::vector<ManylightsSphere> spheres;
    for (int i = 0; i < count; ++i) {
        double x = 8.0 * random.below(camera.view.width / 8 + 1), y = random.between(0, camera.view.height);
        double depth = camera.near_depth * random.octaves(0, 12);
        MlFloat3 point = unproject(camera, {x, y, depth});
        spheres.push_back(light_reaching(random, camera.eye, point, depth * random.octaves(-12, 1), 0.0));
    }
    return spheres;
}

TEST(Precision, CountAndFillAgreeForEveryCell) {
    // Frame::build fences the buffers with canaries and validates: a fill that overran its count would show. Written
    // over two patterns, every byte must be the same: a fill that fell short of its count would leave the pattern.
    std::uint64_t references = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        oracle::Random random(seed);
        oracle::Camera camera = camera_at_origin(random, 300);
        std::vector<ManylightsSphere> spheres = crowd(random, camera, 200);
        for (ManylightsStructure structure : kStructures) {
            ManylightsSettings settings = default_settings(structure);
            settings.tile_px = 8;
            Frame frame(settings);
            ASSERT_TRUE(frame.build({camera.view}, lights_of(spheres), 0x00)) << frame.failure();
            std::vector<std::byte> zeros = frame.bytes();
            ASSERT_TRUE(frame.build({camera.view}, lights_of(spheres), 0xFF)) << frame.failure();
            ASSERT_TRUE(zeros == frame.bytes()) << structure_name(structure) << " seed " << seed;
            std::uint64_t sum = 0;
            // References are in the order of the cells.
            for (std::size_t i = 0; structure == MANYLIGHTS_STRUCTURE_LISTS && i < frame.cell_count(); ++i) {
                const MlCell cell = frame.buffers().cells[i];
                ASSERT_EQ(cell.first, sum);
                sum += cell.count;
            }
            if (structure == MANYLIGHTS_STRUCTURE_LISTS) {
                ASSERT_EQ(sum, frame.reference_count());
                references += sum;
            }
            ASSERT_EQ(frame.stats().references, frame.reference_count());
            ASSERT_EQ(frame.stats().nodes, frame.node_count());
        }
    }
    EXPECT_GT(references, 100000u);
}

} // namespace
} // namespace manylights::test
