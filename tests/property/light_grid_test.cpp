// The grid oracle against brute force: the same lights at every point, however awkward.

#include "reference/oracle/cases.h"
#include "reference/oracle/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <thread>

namespace manylights::oracle {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

MlFloat3 random_point(Random& random, Double3 half_extent) {
    return to_float({random.between(-half_extent.x, half_extent.x), random.between(-half_extent.y, half_extent.y),
                     random.between(-half_extent.z, half_extent.z)});
}

std::vector<std::uint32_t> found_by(const LightGrid& grid, MlFloat3 point) {
    std::vector<std::uint32_t> indices;
    grid.append_affecting(point, indices);
    return indices;
}

/// Returns how many lights affect the points, so that a test can see that it looked at something.
std::size_t expect_equal(const std::vector<RelativeLight>& lights, const std::vector<MlFloat3>& points) {
    const LightGrid grid(lights);
    std::size_t affecting = 0;
    for (const MlFloat3 point : points) {
        const std::vector<std::uint32_t> truth = affecting_lights(point, lights).indices;
        EXPECT_EQ(found_by(grid, point), truth) << "at " << point.x << ", " << point.y << ", " << point.z;
        if (::testing::Test::HasFailure()) return affecting;
        affecting += truth.size();
    }
    return affecting;
}

/// The point and its 26 neighbours, a unit in the last place away.
void add_neighbours(MlFloat3 point, std::vector<MlFloat3>& points) {
    const auto step = [](float value, int way) {
        return way == 0 ? value : std::nextafter(value, way > 0 ? kInfinity : -kInfinity);
    };
    for (int i = 0; i < 27; ++i)
        points.push_back({step(point.x, i % 3 - 1), step(point.y, i / 3 % 3 - 1), step(point.z, i / 9 - 1)});
}

/// Where the light ends along each axis and in a random direction.
void add_surface(Random& random, const RelativeLight& light, std::vector<MlFloat3>& points) {
    const Double3 center = to_double(light.center);
    for (const double range : {-double{light.range}, double{light.range}})
        for (const Double3 axis : {Double3{1, 0, 0}, Double3{0, 1, 0}, Double3{0, 0, 1}, random.direction()})
            add_neighbours(to_float(center + axis * range), points);
}

/// Lights of ranges from 2^low to 2^(high + 1) within a box that scales with the largest.
std::vector<RelativeLight> mixed_lights(Random& random, std::uint32_t count, int low, int high) {
    const double extent = std::ldexp(4.0, high);
    std::vector<RelativeLight> lights;
    for (std::uint32_t i = 0; i < count; ++i)
        lights.push_back(
            {random_point(random, {extent, extent, extent}), static_cast<float>(random.octaves(low, high)), i});
    return lights;
}

TEST(LightGrid, ranges_of_many_octaves) {
    Random random(1);
    for (const int low : {-10, 0, 3}) {
        const std::vector<RelativeLight> lights = mixed_lights(random, 2000, low, 4);
        std::vector<MlFloat3> points;
        for (int i = 0; i < 500; ++i) points.push_back(random_point(random, {80, 80, 80}));
        for (int i = 0; i < 500; ++i) {
            const RelativeLight& near = lights[random.below(2000)];
            points.push_back(to_float(to_double(near.center) + random.direction() * (near.range * random.unit())));
        }
        EXPECT_GT(expect_equal(lights, points), 1000u);
    }
}

TEST(LightGrid, points_on_surfaces_within_a_unit_in_the_last_place) {
    Random random(2);
    for (const double scale : {1.0, 1e-6, 1e6}) {
        std::vector<RelativeLight> lights;
        std::vector<MlFloat3> points;
        for (std::uint32_t i = 0; i < 60; ++i) {
            const float range = static_cast<float>(scale * random.octaves(-2, 2));
            lights.push_back({random_point(random, {8 * scale, 8 * scale, 8 * scale}), range, i});
            add_surface(random, lights.back(), points);
        }
        EXPECT_GT(expect_equal(lights, points), 1000u);
    }
}

TEST(LightGrid, lights_that_reach_a_point_only_just) {
    Random random(3);
    const float eye[3] = {};
    for (int i = 0; i < 500; ++i) {
        const double extent = random.octaves(-20, 20);
        const MlFloat3 point = random_point(random, {extent, extent, extent});
        const ManylightsSphere sphere = light_reaching(random, eye, point, extent * random.octaves(-12, 4), 0.0);
        const RelativeLight light{{sphere.center[0], sphere.center[1], sphere.center[2]}, sphere.range, 7};
        EXPECT_EQ(expect_equal({light}, {point}), 1u);
    }
}

// The box must reach the point's cell, which begins, or ends, at the point: any smaller one loses the light.
TEST(LightGrid, lights_that_reach_the_edge_of_a_cell_only_just) {
    Random random(11);
    for (int i = 0; i < 2000; ++i) {
        const auto whole = [&random] { return static_cast<float>(64 * random.integer(-3, 3)); }; // edges are shorter
        const MlFloat3 edge{whole(), whole(), whole()};
        const float distance = static_cast<float>(random.sign() * random.octaves(-6, 3));
        MlFloat3 center = edge;
        (i % 3 == 0 ? center.x : i % 3 == 1 ? center.y : center.z) += distance;
        std::vector<MlFloat3> points;
        add_neighbours(edge, points);
        EXPECT_GE(expect_equal({{center, least_range(edge, center), 7}}, points), 1u);
    }
}

TEST(LightGrid, corners_of_cells) {
    Random random(4);
    std::vector<RelativeLight> lights;
    std::vector<MlFloat3> points;
    for (std::uint32_t i = 0; i < 400; ++i) {
        // Whole numbers and powers of two: boxes end, and points lie, where cells do.
        const auto whole = [&random] { return static_cast<float>(random.integer(-12, 12)); };
        lights.push_back({{whole(), whole(), whole()}, static_cast<float>(std::ldexp(1.0, random.integer(-2, 3))), i});
        add_neighbours({whole(), whole(), whole()}, points);
    }
    EXPECT_GT(expect_equal(lights, points), 10000u);
}

TEST(LightGrid, huge_ranges_and_tiny_ones) {
    std::vector<RelativeLight> lights;
    std::vector<MlFloat3> points = {{0, 0, 0}, {1, 0, 0}, {1e18f, 0, 0}, {-7e17f, 7e17f, 0}, {3e38f, -3e38f, 3e38f}};
    std::uint32_t index = 0;
    for (const float range : {0.0f, 1e-45f, 1e-30f, 2e-23f, 3e-23f, 4e-23f, 1e-19f, 1e-10f, 1.0f, 1e10f, 1e18f})
        for (const float offset : {0.0f, 0.5f * range, range, 1.0f}) {
            lights.push_back({{offset, 0, 0}, range, index++});
            add_neighbours({offset - range, 0, 0}, points);
            add_neighbours({offset, range, 0}, points);
        }
    EXPECT_GT(expect_equal(lights, points), 1000u);
}

// Squares of distances below 1e-23 are zero in float, and those of such ranges are not always.
TEST(LightGrid, distances_whose_squares_underflow) {
    Random random(5);
    std::vector<RelativeLight> lights;
    std::vector<MlFloat3> points;
    for (std::uint32_t i = 0; i < 100; ++i) {
        lights.push_back(
            {random_point(random, {1e-22, 1e-22, 1e-22}), static_cast<float>(random.octaves(-79, -73)), i});
        points.push_back(random_point(random, {1e-22, 1e-22, 1e-22}));
        add_surface(random, lights.back(), points);
    }
    EXPECT_GT(expect_equal(lights, points), 1000u);
}

TEST(LightGrid, far_coordinates) {
    Random random(6);
    for (const double distance : {1e6, 1e12, 1e18}) {
        std::vector<RelativeLight> lights;
        std::vector<MlFloat3> points = {{0, 0, 0}};
        for (std::uint32_t i = 0; i < 200; ++i) {
            const MlFloat3 center = random_point(random, {distance, distance, distance});
            const double range = i % 4 == 0 ? 1e-12 : i % 4 == 1 ? 3.0 : distance * random.octaves(-24, -20);
            lights.push_back({center, static_cast<float>(range), i});
            add_surface(random, lights.back(), points);
            points.push_back(center);
        }
        EXPECT_GT(expect_equal(lights, points), 200u);
    }
}

TEST(LightGrid, points_outside_all_lights_and_points_that_are_no_numbers) {
    Random random(7);
    std::vector<RelativeLight> lights = mixed_lights(random, 300, -3, 3);
    lights.push_back({{0, 0, 0}, kLargestRange, 300});
    lights.push_back({{3e38f, 0, 0}, kLargestRange, 301});
    std::vector<MlFloat3> points;
    for (const float bad : {1e30f, 3.4e38f, kInfinity, kNan})
        for (int i = 0; i < 27; ++i) {
            const auto pick = [bad](int which) { return which == 0 ? 0.5f : which == 1 ? bad : -bad; };
            points.push_back({pick(i % 3), pick(i / 3 % 3), pick(i / 9)});
        }
    EXPECT_GT(expect_equal(lights, points), 1u);
    EXPECT_TRUE(found_by(LightGrid(lights), {kNan, 0, 0}).empty());
}

TEST(LightGrid, unusable_lights_are_left_out) {
    Random random(8);
    const auto sphere = [](float x, float y, float z, float range) { return ManylightsSphere{{x, y, z}, range}; };
    const ManylightsSphere spheres[] = {
        sphere(0, 0, 0, 1),   sphere(kNan, 0, 0, 1),       sphere(0, kInfinity, 0, 1), sphere(0, 0, 0, -1),
        sphere(0, 0, 0, 0),   sphere(0, 0, 0, kNan),       sphere(0, 0, 0, kInfinity), sphere(3e38f, 0, 0, 1e30f),
        sphere(.5f, 0, 0, 2), sphere(0, 0, -kInfinity, 1), sphere(0, 0, 0, -kInfinity)};
    ManylightsLights lights{};
    lights.size = sizeof lights;
    lights.spheres = spheres;
    lights.count = static_cast<std::uint32_t>(std::size(spheres));
    for (const float eye_x : {0.0f, 0.25f, -3e38f}) { // relative to the last, a centre is infinite
        const float eye[3] = {eye_x, 0, 0};
        const std::vector<RelativeLight> relative = relative_lights(lights, eye);
        const MlFloat3 origin = camera_relative(spheres[0].center, eye);
        EXPECT_EQ(found_by(LightGrid(relative), origin), affecting_lights(origin, relative).indices);
    }
    const float eye[3] = {};
    EXPECT_EQ(found_by(LightGrid(relative_lights(lights, eye)), {0, 0, 0}), (std::vector<std::uint32_t>{0, 6, 8}));
}

TEST(LightGrid, no_lights) { EXPECT_EQ(expect_equal({}, {{0, 0, 0}, {1, 2, 3}, {kNan, 0, 0}}), 0u); }

TEST(LightGrid, all_lights_at_one_point) {
    std::vector<RelativeLight> lights;
    for (std::uint32_t i = 0; i < 3000; ++i) lights.push_back({{1, 2, 3}, 0.01f * static_cast<float>(i % 700), i});
    EXPECT_GT(expect_equal(lights, {{1, 2, 3}, {2, 2, 3}, {1, 2, 3 + 6.99f}, {7, 8, 9}}), 3000u);
}

TEST(LightGrid, duplicates_and_indices_in_any_order) {
    std::vector<RelativeLight> lights;
    for (const std::uint32_t index : {9u, 4u, 4000000000u, 1u})
        for (int copy = 0; copy < 2; ++copy)
            lights.push_back({{0, 0, 0}, index == 4 ? 50.0f : 2.0f, index + 10 * copy});
    EXPECT_EQ(found_by(LightGrid(lights), {0.5f, 0, 0}),
              (std::vector<std::uint32_t>{1, 4, 9, 11, 14, 19, 4000000000u, 4000000010u}));
}

TEST(LightGrid, appends_behind_what_is_there) {
    const LightGrid grid({{{0, 0, 0}, 2, 5}, {{0, 0, 0}, 20, 3}});
    std::vector<std::uint32_t> indices = {8, 7};
    grid.append_affecting({1, 0, 0}, indices);
    grid.append_affecting({5, 0, 0}, indices);
    EXPECT_EQ(indices, (std::vector<std::uint32_t>{8, 7, 3, 5, 3}));
}

/// A valley full of small lights and a few large ones.
std::vector<RelativeLight> valley_lights(Random& random, std::uint32_t count) {
    std::vector<RelativeLight> lights;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double range = random.chance(0.0005) ? random.between(30, 80) : random.between(2, 8);
        lights.push_back({random_point(random, {100, 30, 300}), static_cast<float>(0.75 * range), i});
    }
    return lights;
}

TEST(LightGrid, a_hundred_thousand_lights) {
    Random random(9);
    std::vector<MlFloat3> points;
    for (int i = 0; i < 3000; ++i) points.push_back(random_point(random, {105, 32, 310}));
    EXPECT_GT(expect_equal(valley_lights(random, 100000), points), 10000u);
}

TEST(LightGrid, several_threads_at_once) {
    Random random(10);
    const std::vector<RelativeLight> lights = valley_lights(random, 20000);
    const LightGrid grid(lights);
    std::vector<MlFloat3> points;
    for (int i = 0; i < 2000; ++i) points.push_back(random_point(random, {100, 30, 300}));
    std::vector<std::vector<std::uint32_t>> found(4);
    std::vector<std::thread> threads;
    for (std::vector<std::uint32_t>& indices : found)
        threads.emplace_back([&grid, &points, &indices] {
            for (const MlFloat3 point : points) grid.append_affecting(point, indices);
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_GT(found[0].size(), 2000u);
    for (const std::vector<std::uint32_t>& indices : found) EXPECT_EQ(indices, found[0]);
}

} // namespace
} // namespace manylights::oracle
