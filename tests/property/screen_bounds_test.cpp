// Where a sphere is on the screen: silhouettes, the near plane, corners and edges of tiles.

#include "tests/property/probes.h"

#include <algorithm>
#include <cmath>

namespace manylights::test {
namespace {

ManylightsSettings small_tiles() {
    ManylightsSettings settings = default_settings();
    settings.tile_px = 8;
    return settings;
}

/// The tile of a pixel position lies outside of the tiles of [a, b] (pixel positions, either order).
bool outside_tiles(double position, double a, double b) {
    double tile = std::floor(position / 8.0);
    return tile < std::floor(std::min(a, b) / 8.0) || tile > std::floor(std::max(a, b) / 8.0);
}

/// A point of the sphere's silhouette as the camera sees it, just inside. Where u is a direction perpendicular to c,
/// d = |c|: the line of sight touches the sphere at c (1 - r^2/d^2) + u r sqrt(1 - r^2/d^2).
oracle::Double3 silhouette_point(oracle::Random& random, oracle::Double3 c, double r) {
    double d2 = dot(c, c), k = 1.0 - r * r / d2;
    oracle::Double3 u = random.direction();
    u = u - c * (dot(u, c) / d2);
    oracle::Double3 p = c * k + u * (r * std::sqrt(k) / length(u));
    return c + (p - c) * (1.0 - 1e-6);
}

struct Lobe {
    oracle::Double3 center; ///< x, y along the view axes, view depth
    double radius;
};

/// A sphere in front of the camera that does not hold it.
Lobe sphere_in_front(oracle::Random& random, const oracle::Camera& camera) {
    double depth = camera.near_depth * random.octaves(2, 10);
    oracle::Double3 slopes =
        slopes_at(camera, random.between(0, camera.view.width), random.between(0, camera.view.height));
    oracle::Double3 center{slopes.x * depth, slopes.y * depth, depth};
    return {center, (depth - camera.near_depth) * random.between(0.05, 0.95)};
}

TEST(ScreenBounds, SilhouettesOfSpheresInFrontOfTheCameraAreCovered) {
    Outcome outcome;
    NaiveLoss naive;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        oracle::Random random(seed);
        Trial trial;
        trial.camera = camera_at_origin(random);
        for (int i = 0; i < 100; ++i) {
            auto [c, r] = sphere_in_front(random, trial.camera);
            std::uint32_t light =
                trial.add_light(relative_at(trial.camera, c.x, c.y, c.z), static_cast<float>(r * (1 + 1e-6)));
            for (int k = 0; k < 8; ++k) {
                oracle::Double3 p = silhouette_point(random, c, r);
                if (!trial.add_probe(relative_at(trial.camera, p.x, p.y, p.z), light)) continue;
                oracle::ScreenPosition low = project_slopes(trial.camera, (c.x - r) / c.z, (c.y - r) / c.z);
                oracle::ScreenPosition high = project_slopes(trial.camera, (c.x + r) / c.z, (c.y + r) / c.z);
                oracle::ScreenPosition at = project(trial.camera, trial.probes.back().point);
                naive.count(outside_tiles(at.x, low.x, high.x) || outside_tiles(at.y, low.y, high.y));
            }
        }
        expect_none_lost(trial, small_tiles(), outcome);
    }
    EXPECT_GT(outcome.triples, 5000u);
    EXPECT_GT(naive.lost, naive.probes / 20) << "(x +- r) / z must lose many of " << naive.probes;
}

/// Tangents by the formula alone, without asking whether they lie in front of the camera.
void unguarded_tangents(double x, double z, double r, double& low, double& high) {
    double t = std::sqrt(std::max(x * x + z * z - r * r, 0.0));
    low = (x * t - z * r) / (z * t + x * r);
    high = (x * t + z * r) / (z * t - x * r);
}

TEST(ScreenBounds, SpheresAcrossTheNearPlaneAndBehindTheCameraAreCovered) {
    Outcome outcome;
    NaiveLoss naive;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        oracle::Random random(seed);
        Trial trial;
        trial.camera = camera_at_origin(random);
        double unit = trial.camera.near_depth * 10.0;
        for (int i = 0; i < 100; ++i) {
            oracle::Double3 c{random.between(-4, 4) * unit, random.between(-4, 4) * unit, random.between(-2, 4) * unit};
            double r = random.between(0.0, 5.0) * unit;
            std::uint32_t light = trial.add_light(relative_at(trial.camera, c.x, c.y, c.z), static_cast<float>(r));
            for (int k = 0; k < 16; ++k) {
                oracle::Double3 p = c + random.direction() * (r * (k % 2 ? 1 - 1e-6 : random.unit()));
                if (!trial.add_probe(relative_at(trial.camera, p.x, p.y, p.z), light)) continue;
                double low_x, high_x, low_y, high_y;
                unguarded_tangents(c.x, c.z, r, low_x, high_x);
                unguarded_tangents(c.y, c.z, r, low_y, high_y);
                oracle::ScreenPosition low = project_slopes(trial.camera, low_x, low_y);
                oracle::ScreenPosition high = project_slopes(trial.camera, high_x, high_y);
                oracle::ScreenPosition at = project(trial.camera, trial.probes.back().point);
                naive.count(outside_tiles(at.x, low.x, high.x) || outside_tiles(at.y, low.y, high.y));
            }
        }
        expect_none_lost(trial, small_tiles(), outcome);
    }
    EXPECT_GT(outcome.triples, 3000u);
    EXPECT_GT(naive.lost, naive.probes / 20) << "unguarded tangents must lose many of " << naive.probes;
}

/// A tile culled by its four corner rays alone: kept only if one of them passes through the sphere.
bool misses_all_corner_rays(const oracle::Camera& camera, oracle::ScreenPosition at, oracle::Double3 c, double r) {
    double x0 = std::floor(at.x / 8.0) * 8.0, y0 = std::floor(at.y / 8.0) * 8.0;
    for (int corner = 0; corner < 4; ++corner) {
        oracle::Double3 ray = slopes_at(camera, x0 + (corner & 1) * 8.0, y0 + (corner >> 1) * 8.0);
        oracle::Double3 nearest = ray * (dot(c, ray) / dot(ray, ray));
        if (length(c - nearest) < r) return false;
    }
    return true;
}

TEST(ScreenBounds, PointsInsideASphereNearTheCornersOfTilesAreCovered) {
    Outcome outcome;
    NaiveLoss naive;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        oracle::Random random(seed);
        Trial trial;
        trial.camera = camera_at_origin(random);
        for (int i = 0; i < 200; ++i) {
            // A point beside a tile's corner, and a light that reaches it from anywhere: often from across the corner.
            double x = 8.0 * random.below(trial.camera.view.width / 8 + 1) + random.between(-0.7, 0.7);
            double y = 8.0 * random.below(trial.camera.view.height / 8 + 1) + random.between(-0.7, 0.7);
            double depth = trial.camera.near_depth * random.octaves(1, 4);
            MlFloat3 point = unproject(trial.camera, {x, y, depth});
            trial.spheres.push_back(
                light_reaching(random, trial.camera.eye, point, depth * random.octaves(-10, -2), 1e-5));
            std::uint32_t light = static_cast<std::uint32_t>(trial.spheres.size() - 1);
            if (!trial.add_probe(point, light)) continue;
            oracle::Double3 c =
                depth_space(trial.camera, {trial.spheres[light].center[0], trial.spheres[light].center[1],
                                           trial.spheres[light].center[2]});
            naive.count(
                misses_all_corner_rays(trial.camera, project(trial.camera, point), c, trial.spheres[light].range));
        }
        expect_none_lost(trial, small_tiles(), outcome);
    }
    EXPECT_GT(outcome.triples, 5000u);
    EXPECT_GT(naive.lost, naive.probes / 50) << "corner rays alone must lose some of " << naive.probes;
}

/// The screen interval along x in float, rounded down to tiles without any widening.
bool lost_by_float_tangents(const oracle::Camera& camera, oracle::Double3 c, double r, double position) {
    float x = static_cast<float>(c.x), z = static_cast<float>(c.z), radius = static_cast<float>(r);
    float t = std::sqrt(x * x + z * z - radius * radius);
    float low = (x * t - z * radius) / (z * t + x * radius), high = (x * t + z * radius) / (z * t - x * radius);
    const float* m = camera.view.clip_from_view;
    auto pixel = [&](float slope) {
        float ndc = (m[0] * slope + m[8] * (m[11] < 0.0f ? -1.0f : 1.0f)) / std::fabs(m[11]);
        return (ndc + 1.0f) * 0.5f * static_cast<float>(camera.view.width);
    };
    return outside_tiles(position, pixel(low), pixel(high));
}

TEST(ScreenBounds, LightsThatTouchATilesEdgeAreFoundOnBothSidesOfIt) {
    Outcome outcome;
    NaiveLoss naive;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        oracle::Random random(seed);
        Trial trial;
        trial.camera = camera_at_origin(random);
        trial.camera.view.guard_px = 0.5f;
        if (trial.camera.view.width < 16) continue;
        for (int i = 0; i < 200; ++i) {
            double edge = 8.0 * (1 + random.below((trial.camera.view.width - 1) / 8));
            float position = static_cast<float>(edge);
            for (int steps = random.integer(-2, 2); steps != 0; steps += steps < 0 ? 1 : -1)
                position = std::nextafter(position, steps < 0 ? 0.0f : 1e9f);
            oracle::Double3 slope = slopes_at(trial.camera, position, random.between(0, trial.camera.view.height));
            double depth = trial.camera.near_depth * random.octaves(1, 6);
            // The plane through the camera and the edge has the normal (1, 0, -slope): the light touches it at p.
            oracle::Double3 p{slope.x * depth, slope.y * depth, depth};
            oracle::Double3 normal =
                oracle::Double3{1.0, 0.0, -slope.x} * (random.sign() / std::sqrt(1.0 + slope.x * slope.x));
            double r = depth * random.octaves(-8, -3);
            oracle::Double3 c = p - normal * r;
            MlFloat3 point = relative_at(trial.camera, p.x, p.y, p.z),
                     center = relative_at(trial.camera, c.x, c.y, c.z);
            std::uint32_t light = trial.add_light(center, oracle::least_range(point, center));
            if (!trial.add_probe(point, light)) continue;
            naive.count(lost_by_float_tangents(trial.camera, depth_space(trial.camera, center),
                                               trial.spheres[light].range, project(trial.camera, point).x));
        }
        expect_none_lost(trial, small_tiles(), outcome);
    }
    EXPECT_GT(outcome.triples, 5000u);
    EXPECT_GT(naive.lost, naive.probes / 50) << "bounds without widening must lose some of " << naive.probes;
}

} // namespace
} // namespace manylights::test
