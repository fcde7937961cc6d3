#pragma once
// Lights and points of one test, asked of all structures; and the same inputs counted against a naive form, so
// that a test shows that its inputs can tell the two apart.

#include "tests/property/promise.h"

#include <gtest/gtest.h>

#include <vector>

namespace manylights::test {

/// A point that a light affects. Where the float predicate disagrees the probe is dropped.
struct Probe {
    MlFloat3 point;
    std::uint32_t light;
};

struct Trial {
    oracle::Camera camera;
    std::vector<ManylightsSphere> spheres;
    std::vector<Probe> probes;

    /// center: relative to the camera. Returns the light's index.
    std::uint32_t add_light(MlFloat3 center, float range);
    /// Adds the probe if the float predicate accepts the point and it is in view. False: dropped.
    bool add_probe(MlFloat3 point, std::uint32_t light);
};

/// From a position with x and y along the view axes and view depth, to camera-relative.
MlFloat3 relative_at(const oracle::Camera& camera, double x, double y, double depth);
/// And back: x and y along the view axes, and view depth.
oracle::Double3 depth_space(const oracle::Camera& camera, MlFloat3 relative);
/// The pixel positions of slopes x / depth and y / depth.
oracle::ScreenPosition project_slopes(const oracle::Camera& camera, double slope_x, double slope_y);
/// The slopes of a pixel position.
oracle::Double3 slopes_at(const oracle::Camera& camera, double x, double y);

/// A random camera at the world's origin.
oracle::Camera camera_at_origin(oracle::Random& random, std::uint32_t largest_edge_px = 1000);

/// Builds every structure, asks for every probe at all promised pixels and depths, and expects that none is
/// lost. What was checked is added to the outcome (once per probe, not per structure).
void expect_none_lost(const Trial& trial, const ManylightsSettings& settings, Outcome& outcome);

/// How many probes a naive form would lose, of how many.
struct NaiveLoss {
    int lost = 0, probes = 0;

    void count(bool is_lost) {
        ++probes;
        lost += is_lost ? 1 : 0;
    }
};

} // namespace manylights::test
