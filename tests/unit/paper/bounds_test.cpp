#include "reference/paper/bounds.h"
#include "tests/unit/paper/cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace manylights::paper {
namespace {

// Both ends move outward by the 2^-20 that the promise gives to a query's depth, whatever the radius adds.
TEST(Bounds, DepthRangesAreWidened) {
    const Camera camera = read_camera(make_view({}));
    const Grid grid = make_grid(camera, 48);
    SliceTable slices;
    slices.update({}, 16);
    Random random(1);
    for (int i = 0; i < 10000; ++i) {
        const CulledLight light{0.0f, 0.0f, float(random.between(-5, 2000)), float(random.between(0.01, 20)), 0};
        CellBox box;
        CellLight cell_light;
        bound(camera, grid, slices, light, box, cell_light);
        const double lower = double(light.depth) - light.radius, upper = double(light.depth) + light.radius;
        ASSERT_LE(cell_light.min_depth, lower - 0x1p-20 * std::abs(lower));
        ASSERT_GE(cell_light.max_depth, upper + 0x1p-20 * std::abs(upper));
        ASSERT_NEAR(cell_light.min_depth, lower, 1e-5 * (std::abs(light.depth) + light.radius)); // and not by much
        ASSERT_NEAR(cell_light.max_depth, upper, 1e-5 * (std::abs(light.depth) + light.radius));
    }
}

// The interval of pixels of a disc in the plane y = 0, by sampling its border.
TEST(Bounds, ColumnsAreThoseOfTheSilhouette) {
    const Camera camera = read_camera(make_view({}));
    const Grid grid = make_grid(camera, 8);
    SliceTable slices;
    slices.update({}, 1);
    Random random(2);
    int partly_visible = 0;
    for (int i = 0; i < 1000; ++i) {
        const double radius = random.between(0.1, 6.0), depth = random.between(-4.0, 20.0);
        const CulledLight light{float(random.between(-10, 10)), 0.0f, float(depth), float(radius), 0};
        double first = 1e30, last = -1e30;
        for (int step = 0; step < 4000; ++step) {
            const double angle = step * (2.0 * 3.14159265358979 / 4000.0);
            const double z = light.depth + light.radius * std::sin(angle);
            if (z < camera.near_depth) continue;
            const double pixel = camera.scale_x * (light.x + light.radius * std::cos(angle)) / z + camera.center_x;
            first = std::min(first, pixel);
            last = std::max(last, pixel);
        }
        CellBox box;
        CellLight cell_light;
        const bool touches = bound(camera, grid, slices, light, box, cell_light);
        const double left = std::floor(std::max(first, 0.0) / 8.0), right = std::floor(std::min(last, 639.0) / 8.0);
        if (first < 640.0 && last >= 0.0) {
            ASSERT_TRUE(touches);
            ++partly_visible;
            EXPECT_LE(box.first_cell % grid.tiles_x, left);
            EXPECT_GE(box.first_cell % grid.tiles_x + box.columns - 1, right);
        }
        // Away from the near plane, where sampling the border is as good as the silhouette, there is no tile too many.
        if (touches && depth - radius > 1.0) {
            EXPECT_LE(box.columns, std::max(right - left, 0.0) + 2.0);
        }
    }
    EXPECT_GT(partly_visible, 300);
}

} // namespace
} // namespace manylights::paper
