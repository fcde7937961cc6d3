// The camera that is recognised from two matrices: position, depth, planes and pixels, in every convention.

#include "src/build/camera.h"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace manylights::test {
namespace {

using detail::Camera;

constexpr Projection kProjections[] = {Projection::kStandard, Projection::kReversed, Projection::kInfinite,
                                       Projection::kReversedInfinite, Projection::kOpenGl};

Camera recognise(const ManylightsView& view) {
    Camera camera{};
    const detail::Outcome outcome = detail::recognise_camera(view, 0, camera);
    EXPECT_TRUE(outcome.ok()) << outcome.field << " " << outcome.rule;
    return camera;
}

// Depth and pixel of a world point, as the camera has it.
struct Seen {
    double depth, x, y;
};

Seen see(const Camera& camera, const double (&point)[3]) {
    double v[3];
    for (int i = 0; i < 3; ++i) {
        v[i] = 0.0;
        for (int k = 0; k < 3; ++k)
            v[i] += camera.rotation[i][k] * (point[k] - static_cast<double>(camera.position[k]));
    }
    return {v[2], camera.axes[0].origin + camera.axes[0].scale * v[0] / v[2],
            camera.axes[1].origin + camera.axes[1].scale * v[1] / v[2]};
}

// The same from the matrices alone, as a rasteriser does.
Seen rasterise(const ManylightsView& view, const double (&point)[3]) {
    const auto apply = [](const float(&m)[16], const double(&p)[4], double(&out)[4]) {
        for (int r = 0; r < 4; ++r) {
            out[r] = 0.0;
            for (int c = 0; c < 4; ++c) out[r] += static_cast<double>(m[4 * c + r]) * p[c];
        }
    };
    double in_view[4];
    double clip[4];
    apply(view.view_from_world, {point[0], point[1], point[2], 1.0}, in_view);
    apply(view.clip_from_view, in_view, clip);
    const double y = clip[1] / clip[3] * (view.clip_y_up != 0 ? -1.0 : 1.0);
    return {std::fabs(in_view[2]), (clip[0] / clip[3] * 0.5 + 0.5) * view.width, (y * 0.5 + 0.5) * view.height};
}

TEST(Camera, SeesWhatARasteriserSeesInEveryConvention) {
    Random random(5);
    for (const Projection projection : kProjections) {
        for (const bool negative : {true, false}) {
            for (const std::uint32_t up : {0u, 1u}) {
                CameraOptions options;
                options.projection = projection;
                options.looks_down_negative_z = negative;
                options.position = {3.0, -2.0, 7.0};
                options.yaw = 0.7;
                ManylightsView view = make_view(options);
                view.clip_y_up = up;
                view.clip_from_view[8] = 0.3f; // off centre
                view.clip_from_view[9] = -0.2f;
                const Camera camera = recognise(view);
                for (int i = 0; i < 20; ++i) {
                    // Somewhere in front: along the viewing direction, and a little to the sides.
                    const double along = random.between(1, 50);
                    const double s = std::sin(options.yaw);
                    const double c = std::cos(options.yaw);
                    const double point[3] = {3.0 - s * along + random.unit(), -2.0 + random.unit(),
                                             7.0 - c * along + random.unit()};
                    const Seen seen = see(camera, point);
                    const Seen drawn = rasterise(view, point);
                    EXPECT_NEAR(seen.depth, drawn.depth, 1e-5 * drawn.depth);
                    EXPECT_NEAR(seen.x, drawn.x, 1e-2);
                    EXPECT_NEAR(seen.y, drawn.y, 1e-2);
                    EXPECT_GT(seen.depth, 0.0);
                }
            }
        }
    }
}

// Conservative: not behind the near plane, not before the far plane, and not far off.
TEST(Camera, FindsTheDepthPlanes) {
    for (const Projection projection : kProjections) {
        for (const double near_depth : {0.01, 0.1, 1.0, 30.0}) {
            for (const double far_depth : {40.0, 1000.0, 100000.0}) {
                CameraOptions options;
                options.projection = projection;
                options.near_depth = near_depth;
                options.far_depth = far_depth;
                const Camera camera = recognise(make_view(options));
                EXPECT_LT(camera.near_depth, near_depth);
                EXPECT_GT(camera.near_depth, 0.45 * near_depth);
                EXPECT_GT(camera.far_depth, far_depth);
                const bool infinite =
                    projection == Projection::kInfinite || projection == Projection::kReversedInfinite;
                if (infinite) {
                    EXPECT_TRUE(std::isinf(camera.far_depth));
                } else if (far_depth / near_depth < 1e4) {
                    EXPECT_LT(camera.far_depth, 4.1 * far_depth);
                }
            }
        }
    }
}

TEST(Camera, TakesAnObliqueOrMissingDepthRowAsNoPlanes) {
    ManylightsView view = make_view();
    view.clip_from_view[2] = 0.25f;
    EXPECT_EQ(recognise(view).near_depth, 0.0);
    EXPECT_TRUE(std::isinf(recognise(view).far_depth));
    view = make_view();
    view.clip_from_view[14] = 0.0f;
    EXPECT_EQ(recognise(view).near_depth, 0.0);
}

TEST(Camera, ScalesOfTheWholeMatrixDoNotMatter) {
    ManylightsView view = make_view();
    const Camera plain = recognise(view);
    for (float& x : view.clip_from_view) x *= 4.0f;
    const Camera scaled = recognise(view);
    EXPECT_EQ(plain.axes[0].scale, scaled.axes[0].scale);
    EXPECT_EQ(plain.axes[1].origin, scaled.axes[1].origin);
    EXPECT_EQ(plain.near_depth, scaled.near_depth);
}

TEST(Camera, FindsThePositionFarFromTheOrigin) {
    CameraOptions options;
    options.position = {100000.0, -50000.0, 25000.0};
    options.yaw = 1.1;
    const Camera camera = recognise(make_view(options));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(camera.position[k], options.position[k], 0.02);
    EXPECT_NEAR(camera.position_extent, 100000.0, 0.02);
    EXPECT_LT(camera.skew, 1e-6);
}

TEST(Camera, AcceptsAMirroredRotationAndMeasuresSkew) {
    ManylightsView view = make_view();
    view.view_from_world[0] = -1.0f;
    EXPECT_LT(recognise(view).skew, 1e-6);
    view.view_from_world[4] = 3e-4f;
    const double skew = recognise(view).skew;
    EXPECT_GT(skew, 3e-4);
    EXPECT_LT(skew, 5e-4);
}

} // namespace
} // namespace manylights::test
