// The bounds that shaders build with, against points of spheres in double precision: nothing is outside, and not much
// is inside in vain.

#include "lab/techniques/device/sphere_bounds.h"
#include "reference/oracle/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace manylights::lab {
namespace {

using oracle::Random;

constexpr int kSpheres = 20000, kPoints = 24;
constexpr float kSize = 1920.0f, kPixelsPerSlope = 1662.7f, kReach = 0.55f;

struct Ball {
    float offset, depth, radius;
};

// Near and far, in front, beside and around the camera; some all but touch the camera or a pixel's edge.
Ball random_ball(Random& random) {
    const double depth = std::exp2(random.between(-5, 12)) * (random.unit() < 0.1 ? -1.0 : 1.0);
    const double radius = std::fabs(depth) * std::exp2(random.between(-12, 2));
    double offset = depth * random.between(-2.0, 2.0);
    if (random.unit() < 0.2) offset = std::sqrt(std::max(radius * radius - depth * depth, 0.0)) * (1.0 + 1e-6);
    return {static_cast<float>(offset), static_cast<float>(depth), static_cast<float>(radius)};
}

struct Point {
    double offset, depth;
};

// Inside the disc, most of them at its rim.
Point random_point(Random& random, const Ball& ball) {
    const double angle = random.between(0.0, 6.283185307179586);
    const double length = ball.radius * (random.unit() < 0.7 ? 1.0 : random.unit());
    return {ball.offset + length * std::cos(angle), ball.depth + length * std::sin(angle)};
}

double place_of(const Point& point) { return 0.5 * kSize + kPixelsPerSlope * (point.offset / point.depth); }

TEST(SphereBounds, HoldTheSlopesOfAllPointsInFrontOfTheCamera) {
    Random random(1);
    int bounded = 0;
    for (int i = 0; i < kSpheres; ++i) {
        const Ball ball = random_ball(random);
        const double greatest = greatest_slope(ball.offset, ball.depth, ball.radius);
        bounded += greatest < kSteepest ? 1 : 0;
        for (int p = 0; p < kPoints; ++p) {
            const Point point = random_point(random, ball);
            if (!(point.depth > 1e-9) || !(std::fabs(point.offset / point.depth) < kSteepest)) continue;
            ASSERT_LE(point.offset / point.depth, greatest) << ball.offset << " " << ball.depth << " " << ball.radius;
        }
    }
    EXPECT_GT(bounded, kSpheres / 3);
}

TEST(SphereBounds, AreTight) {
    for (const Ball ball : {Ball{0, 10, 1}, Ball{30, 10, 3}, Ball{-5, 100, 20}, Ball{0.1f, 0.5f, 0.2f}}) {
        const double d = std::hypot(ball.offset, ball.depth);
        const double exact = std::tan(std::atan2(ball.offset, ball.depth) + std::asin(ball.radius / d));
        EXPECT_NEAR(greatest_slope(ball.offset, ball.depth, ball.radius), exact, 1e-4 * (1.0 + std::fabs(exact)));
    }
}

TEST(SphereBounds, HoldThePixelsWhosePointsAreInTheDisc) {
    Random random(2);
    int inside = 0;
    for (int i = 0; i < kSpheres; ++i) {
        const Ball ball = random_ball(random);
        const PixelSpan span = pixel_span(ball.offset, ball.depth, ball.radius, kPixelsPerSlope, kSize, kReach);
        for (int p = 0; p < kPoints; ++p) {
            const Point point = random_point(random, ball);
            if (!(point.depth > 1e-9)) continue;
            const double place = place_of(point);
            for (const double pixel : {std::floor(place - 0.5), std::ceil(place - 0.5)}) {
                if (pixel < 0 || pixel > kSize - 1 || std::fabs(place - pixel - 0.5) > 0.5) continue;
                ++inside;
                ASSERT_LE(span.first, pixel);
                ASSERT_GE(span.last, pixel);
            }
        }
    }
    EXPECT_GT(inside, kSpheres);
    EXPECT_GT(pixel_span(100, 10, 1, kPixelsPerSlope, kSize, kReach).first,
              pixel_span(100, 10, 1, kPixelsPerSlope, kSize, kReach).last);
}

TEST(SphereBounds, HoldTheDepthsOfTheSphereBetweenTwoPixels) {
    Random random(3);
    int inside = 0, empty = 0;
    for (int i = 0; i < kSpheres; ++i) {
        const Ball ball = random_ball(random);
        const MlUint first = random.below(1900);
        const MlUint last = std::min(first + (random.unit() < 0.5 ? 47u : random.below(800)), 1919u);
        const float low = pixel_edge_slope(first, -1.0f, kPixelsPerSlope, kSize, kReach);
        const float high = pixel_edge_slope(last, 1.0f, kPixelsPerSlope, kSize, kReach);
        const DepthSpan span = wedge_depths(low, high, ball.offset, ball.depth, ball.radius);
        empty += span.low > span.high ? 1 : 0;
        for (int p = 0; p < kPoints; ++p) {
            const Point point = random_point(random, ball);
            if (!(point.depth > 0.0) || place_of(point) < first || place_of(point) > last + 1.0) continue;
            ++inside;
            ASSERT_LE(span.low, point.depth);
            ASSERT_GE(span.high, point.depth);
        }
    }
    EXPECT_GT(inside, kSpheres / 10);
    EXPECT_GT(empty, kSpheres / 3);
    EXPECT_GT(wedge_depths(-1.0f, 1.0f, 30.0f, 10.0f, 5.0f).low, wedge_depths(-1.0f, 1.0f, 30.0f, 10.0f, 5.0f).high);
}

// Beside the wedge only a cap is inside: it begins at its rim, and has the sphere's far pole.
TEST(SphereBounds, NarrowDepthsToTheCap) {
    const DepthSpan span = wedge_depths(-1.0f, 1.0f, 14.0f, 10.0f, 5.0f);
    const double h = (10.0 - 14.0) / std::sqrt(2.0), center = 10.0 - h / std::sqrt(2.0);
    const double reach = std::sqrt(25.0 - h * h) / std::sqrt(2.0);
    EXPECT_NEAR(span.low, center - reach, 1e-3);
    EXPECT_NEAR(span.high, 15.0, 1e-3);
    EXPECT_NEAR(wedge_depths(-1.0f, 1.0f, 16.0f, 10.0f, 5.0f).high, 13.0 + std::sqrt(25.0 - 18.0) / std::sqrt(2.0),
                1e-3);
}

struct Ball3 {
    float right, below, depth, radius;
};

struct Point3 {
    double right, below, depth;
};

bool is_on(const SlopeBound& bound, double offset, double depth) {
    return bound.side * (offset - bound.slope * depth) >= 0.0;
}

double distance(const Ball3& ball, const Point3& point) {
    return std::hypot(ball.right - point.right, ball.below - point.below, ball.depth - point.depth);
}

/// A ball beside the edge in which the planes meet: it touches a point of it, for reach 1, from the outside.
struct EdgeCase {
    SlopeBound across, down;
    Point3 touched;
    Ball3 ball;
};

EdgeCase random_edge_case(Random& random, double reach) {
    const auto bound = [&] {
        return SlopeBound{static_cast<float>(random.between(-1.5, 1.5)), random.chance(0.5) ? 1.0f : -1.0f};
    };
    EdgeCase made{bound(), bound(), {}, {}};
    const double depth = std::exp2(random.between(-5, 12)), radius = depth * std::exp2(random.between(-12, 2));
    made.touched = {made.across.slope * depth, made.down.slope * depth, depth};
    // A direction outwards of both planes: a sum of their normals, times -1.
    const double a = made.across.side * random.between(0.01, 1), b = made.down.side * random.between(0.01, 1);
    const Point3 out{-a, -b, a * made.across.slope + b * made.down.slope};
    const double scale = radius * reach / std::hypot(out.right, out.below, out.depth);
    made.ball = {static_cast<float>(made.touched.right + scale * out.right),
                 static_cast<float>(made.touched.below + scale * out.below),
                 static_cast<float>(depth + scale * out.depth), static_cast<float>(radius)};
    return made;
}

bool misses(const EdgeCase& made) {
    return misses_edge(made.across, made.down, made.ball.right, made.ball.below, made.ball.depth, made.ball.radius);
}

TEST(SphereBounds, KeepWhatTouchesTheEdgeOfTwoPlanesAndDropWhatIsBesideIt) {
    Random random(4);
    int dropped = 0;
    for (int i = 0; i < kSpheres; ++i) {
        const EdgeCase inside = random_edge_case(random, 1.0 - 1e-9);
        ASSERT_FALSE(misses(inside) && distance(inside.ball, inside.touched) <= inside.ball.radius) << i;
        // As far away as rounding must not matter.
        const EdgeCase outside = random_edge_case(random, 1.0 + 1e-4 + 1e-5 * std::exp2(12));
        dropped += misses(outside) ? 1 : 0;
    }
    EXPECT_GT(dropped, kSpheres * 9 / 10);
}

TEST(SphereBounds, KeepTheSphereOfEachPointThatIsOnBothSides) {
    Random random(5);
    int inside = 0, dropped = 0;
    for (int i = 0; i < kSpheres; ++i) {
        const EdgeCase made = random_edge_case(random, random.between(-3.0, 1.2));
        dropped += misses(made) ? 1 : 0;
        for (int p = 0; p < kPoints; ++p) {
            const oracle::Double3 offset = random.direction() * (made.ball.radius * 0.9999999);
            const Point3 point{made.ball.right + offset.x, made.ball.below + offset.y, made.ball.depth + offset.z};
            if (!is_on(made.across, point.right, point.depth) || !is_on(made.down, point.below, point.depth)) continue;
            ++inside;
            ASSERT_FALSE(misses(made)) << i;
        }
    }
    EXPECT_GT(inside, kSpheres);
    EXPECT_GT(dropped, kSpheres / 100);
}

} // namespace
} // namespace manylights::lab
