// The depths of a sphere in a tile's pyramid: never less than what its points show, and not much more.

#include "src/build/lanes.h"
#include "src/build/narrow.h"
#include "tests/unit/library/frame.h"

#include <hwy/highway.h>

#include "src/build/narrow-inl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace manylights::test {
namespace {

using detail::Axis;
using detail::Interval;
using detail::TileWedge;

// One lane; tests/unit/library/targets_test.cpp holds all others to the same bits.
namespace lanes = detail::HWY_NAMESPACE;
constexpr hwy::HWY_NAMESPACE::CappedTag<float, 1> kLane;
using Lane = hwy::HWY_NAMESPACE::Vec<decltype(kLane)>;

double to_double(Lane lane) { return static_cast<double>(hwy::HWY_NAMESPACE::GetLane(lane)); }
Lane to_lane(double value) { return hwy::HWY_NAMESPACE::Set(kLane, static_cast<float>(value)); }

struct WedgeCut {
    lanes::WedgeCuts<Lane> lane;
    Interval depths; // finished
    double distance;
};

using Sphere = lanes::WedgeSpheres<Lane>;

// A sphere in doubles has one in floats around it: its centre moves by 2^-23 of |c| at most.
Sphere sphere_around(double offset, double depth, double radius, double other_offset) {
    const double distance = std::sqrt(offset * offset + depth * depth + other_offset * other_offset);
    const Lane radius_lane = to_lane(radius * (1.0 + 0x1p-22) + 0x1p-22 * distance);
    const Lane slack = lanes::narrow_slack(to_lane(offset), to_lane(other_offset), to_lane(depth), radius_lane);
    return {to_lane(offset), to_lane(depth), radius_lane, slack};
}

WedgeCut cut_wedge(const TileWedge& wedge, const Sphere& sphere) {
    WedgeCut cut{lanes::uncut(sphere), {}, 0.0};
    for (const detail::SidePlane& side : wedge.sides)
        lanes::cut_side(sphere, to_lane(side.offset), to_lane(side.depth), cut.lane);
    cut.depths = {to_double(lanes::finish_low(cut.lane.low, cut.lane.low, sphere.slack)),
                  to_double(lanes::finish_high(cut.lane.high, cut.lane.high, sphere.slack))};
    cut.distance = to_double(cut.lane.distance);
    return cut;
}

WedgeCut cut_wedge(const TileWedge& wedge, double offset, double depth, double radius, double other_offset = 0.0) {
    return cut_wedge(wedge, sphere_around(offset, depth, radius, other_offset));
}

struct Point {
    double x, y, depth;
};

struct Ball {
    Point center;
    double radius;
};

// What a pixel of the tile is promised, of an axis: by the position that the point projects to, not by planes.
struct Strip {
    Axis axis;
    std::uint32_t first_px, last_px;
    double guard_px;

    TileWedge wedge() const { return detail::tile_wedge(axis, first_px, last_px, guard_px); }
    bool holds(double offset, double depth) const {
        if (!(depth > 0.0)) return false;
        const double position = axis.origin + axis.scale * (offset / depth);
        return position >= first_px + 0.5 - guard_px && position <= last_px + 0.5 + guard_px;
    }
    double slope_of(double position) const { return (position - axis.origin) / axis.scale; }
};

// Mirrored and off-centre axes among them.
Strip random_strip(Random& random) {
    const auto size = static_cast<std::uint32_t>(random.between(100, 4000));
    const double sign = random.unit() < 0.5 ? -1.0 : 1.0;
    const Axis axis = {sign * size * random.between(0.1, 3.0), size * random.between(-2.0, 3.0), size};
    const auto first = static_cast<std::uint32_t>(random.between(0, size - 50));
    return {axis, first, first + static_cast<std::uint32_t>(random.between(0, 49)), random.between(0.0, 2.0)};
}

// Most are near one of the strip's planes, some only just touch it, some hold the camera, some are behind it.
Ball random_ball(Random& random, const Strip& columns, const Strip& rows) {
    const double depth = std::exp2(random.between(-6, 12));
    const double radius = depth * std::exp2(random.between(-12, 3));
    const auto offset = [&](const Strip& strip) {
        const double slope = strip.slope_of(random.unit() < 0.5 ? strip.first_px - 0.0 : strip.last_px + 1.0);
        const double touch = random.unit() < 0.3 ? 1.0 - std::exp2(random.between(-30, -4)) : random.between(-1.5, 1.5);
        return slope * depth + (random.unit() < 0.5 ? -1 : 1) * touch * radius * std::sqrt(1.0 + slope * slope);
    };
    const double z = random.unit() < 0.1 ? -0.5 * radius : depth;
    return {{offset(columns), offset(rows), z}, radius};
}

// A direction's point at a part of the radius.
Point point_at(const Ball& ball, double u, double angle, double part) {
    const double ring = std::sqrt(std::max(1.0 - u * u, 0.0));
    const double r = ball.radius * part;
    return {ball.center.x + r * ring * std::cos(angle), ball.center.y + r * ring * std::sin(angle),
            ball.center.depth + r * u};
}

// Where the sphere meets the plane x = slope * depth, all around and a little inside: the depths that a cap's extremes
// have lie there.
Point point_on_cut(const Ball& ball, double slope, double angle, double part) {
    const double length = std::sqrt(1.0 + slope * slope);
    const double h = (ball.center.x - slope * ball.center.depth) / length;
    const double rim = std::sqrt(std::max((ball.radius - h) * (ball.radius + h), 0.0)) * part;
    const double along = rim * std::cos(angle);
    return {ball.center.x - h / length + along * slope / length, ball.center.y + rim * std::sin(angle),
            ball.center.depth + h * slope / length + along / length};
}

double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y, a.depth - b.depth); }

// Points of the ball, dense where bounds are tight.
std::vector<Point> sample(Random& random, const Ball& ball, const Strip& columns) {
    std::vector<Point> points;
    for (int i = 0; i < 300; ++i)
        points.push_back(point_at(ball, random.between(-1, 1), random.between(0, 6.2831853), std::cbrt(random.unit())));
    for (int i = 0; i < 64; ++i) points.push_back(point_at(ball, i % 2 == 0 ? 1.0 : -1.0, 0.0, 1.0 - i * 1e-3));
    for (const double position : {columns.first_px + 0.5 - columns.guard_px, columns.last_px + 0.5 + columns.guard_px})
        for (int i = 0; i < 128; ++i)
            points.push_back(point_on_cut(ball, columns.slope_of(position), i * 3.14159265358979 / 64.0, 1.0 - 1e-12));
    std::erase_if(points, [&](const Point& p) { return distance(p, ball.center) > ball.radius; });
    return points;
}

TEST(Narrow, HoldsEveryPointOfTheSphereThatAPixelOfTheTileIsPromised) {
    Random random(21);
    std::uint64_t held = 0;
    std::uint64_t narrowed = 0;
    std::uint64_t smaller = 0;
    for (int i = 0; i < 20000; ++i) {
        const Strip columns = random_strip(random);
        const Strip rows = random_strip(random);
        const Ball ball = random_ball(random, columns, rows);
        const Sphere along_x = sphere_around(ball.center.x, ball.center.depth, ball.radius, ball.center.y);
        const WedgeCut column = cut_wedge(columns.wedge(), along_x);
        const WedgeCut row = cut_wedge(rows.wedge(), ball.center.y, ball.center.depth, ball.radius, ball.center.x);
        const WedgeCut cap = cut_wedge(columns.wedge(), lanes::caps_of(along_x, row.lane));
        smaller += cap.depths.high - cap.depths.low < 0.9 * (column.depths.high - column.depths.low) ? 1 : 0;
        narrowed += column.depths.high - column.depths.low < 1.9 * ball.radius ? 1 : 0;
        for (const Point& p : sample(random, ball, columns)) {
            if (!columns.holds(p.x, p.depth)) continue;
            ASSERT_TRUE(column.depths.low <= p.depth && p.depth <= column.depths.high) << i;
            if (!rows.holds(p.y, p.depth)) continue;
            ++held;
            ASSERT_TRUE(row.depths.low <= p.depth && p.depth <= row.depths.high) << i;
            ASSERT_TRUE(cap.depths.low <= p.depth && p.depth <= cap.depths.high) << i;
        }
    }
    EXPECT_GT(held, 200000u);
    EXPECT_GT(narrowed, 8000u) << "the planes must cut most of these spheres";
    EXPECT_GT(smaller, 4000u) << "a cap's ball must be narrower where its centre is beside the row";
}

// The depths of a sphere inside one half-space, in doubles and without any slack. false: they do not meet.
bool exact_depths(double slope, double offset, double depth, double radius, Interval& depths) {
    const double length = std::sqrt(1.0 + slope * slope);
    const double h = (offset - slope * depth) / length;
    if (h <= -radius) return false;
    const double rim = std::sqrt(std::max((radius - h) * (radius + h), 0.0)) / length;
    const double middle = depth + h * slope / length;
    depths.low = h + radius * slope / length >= 0.0 ? depth - radius : middle - rim;
    depths.high = h - radius * slope / length >= 0.0 ? depth + radius : middle + rim;
    return true;
}

// Spheres that are just touched, where the depths of a cap change most: what floats make of plane and sphere must hold
// what doubles do, and the 2^-20 that a caller's depth may be off.
TEST(Narrow, HoldsInFloatsWhatDoublesFindBesideAPlane) {
    Random random(24);
    int met = 0;
    for (int i = 0; i < 300000; ++i) {
        const double slope = random.between(-3, 3) * std::exp2(random.between(-4, 3));
        const double length = std::sqrt(1.0 + slope * slope);
        const float depth = static_cast<float>(std::exp2(random.between(-6, 12)));
        const float radius = static_cast<float>(depth * std::exp2(random.between(-12, 3)));
        const double touch = std::exp2(random.between(-30, -1)) * (random.unit() < 0.1 ? -1.0 : 1.0);
        const float offset = static_cast<float>(slope * depth - radius * (1.0 - touch) * length);
        Interval exact{};
        if (!exact_depths(slope, offset, depth, radius, exact)) continue;
        ++met;
        const Lane slack = lanes::narrow_slack(to_lane(offset), to_lane(0.0), to_lane(depth), to_lane(radius));
        const lanes::WedgeSpheres<Lane> sphere = {to_lane(offset), to_lane(depth), to_lane(radius), slack};
        lanes::WedgeCuts<Lane> cut = lanes::uncut(sphere);
        lanes::cut_side(sphere, to_lane(1.0 / length), to_lane(-slope / length), cut);
        ASSERT_LE(to_double(lanes::finish_low(cut.low, cut.low, slack)), exact.low - 0x1p-20 * std::fabs(exact.low));
        ASSERT_GE(to_double(lanes::finish_high(cut.high, cut.high, slack)),
                  exact.high + 0x1p-20 * std::fabs(exact.high));
    }
    EXPECT_GT(met, 150000);
}

// A sphere on the axis, the plane x = depth: its foot is at (d / 2, d / 2).
TEST(Narrow, HasTheDepthsOfTheCapThatAPlaneCuts) {
    const double d = 10.0;
    const double r = 8.0;
    const double half = std::sqrt(0.5);
    const TileWedge one_plane = {{{half, -half}, {half, -half}}};
    const WedgeCut cut = cut_wedge(one_plane, 0.0, d, r);
    const double h = d * half;
    const double rim = std::sqrt(r * r - h * h) * half;
    EXPECT_NEAR(cut.depths.low, 5.0 - rim, 1e-4);
    EXPECT_NEAR(cut.depths.high, 5.0 + rim, 1e-4);
    EXPECT_NEAR(cut.distance, -h, 1e-4);
    EXPECT_TRUE(cut_wedge(one_plane, 0.0, d, 7.0).depths.empty()) << "the plane is 7.07 away";
    EXPECT_FALSE(cut_wedge(one_plane, 0.0, d, 7.08).depths.empty());
}

// Tiles of 32 pixels that a sphere's rectangle spans, in a common camera: against the depths of many of its points.
TEST(Narrow, IsTightOnOrdinaryLights) {
    Random random(22);
    double found = 0.0;
    double sampled = 0.0;
    double whole = 0.0;
    for (int i = 0; i < 400; ++i) {
        const Axis axis = {1000.0, 500.0, 1000};
        const auto first = 32 * static_cast<std::uint32_t>(random.between(0, 30));
        const Strip strip = {axis, first, first + 31, 0.5};
        const double depth = random.between(20, 300);
        const double slope = strip.slope_of(random.between(first - 40.0, first + 72.0));
        const Ball ball = {{slope * depth, 0.0, depth}, random.between(2, 8)};
        Interval seen = {1e300, -1e300};
        for (int k = 0; k < 4000; ++k) {
            const Point p = point_at(ball, random.between(-1, 1), random.between(0, 6.2831853), 1.0);
            if (!strip.holds(p.x, p.depth)) continue;
            seen = {std::min(seen.low, p.depth), std::max(seen.high, p.depth)};
        }
        if (seen.empty()) continue;
        const Interval depths = cut_wedge(strip.wedge(), ball.center.x, ball.center.depth, ball.radius).depths;
        found += depths.high - depths.low;
        sampled += seen.high - seen.low;
        whole += 2.0 * ball.radius;
    }
    EXPECT_LT(found, 1.1 * sampled);
    EXPECT_GT(whole, 1.05 * found) << "the whole range must be looser";
}

// A sphere above the row y <= 0, whose cap is the ball of radius 3 around its foot; columns are planes x >= distance.
TEST(Narrow, CutsTheCapThatTheRowHolds) {
    const Sphere sphere = sphere_around(0.0, 10.0, 5.0, 4.0);
    lanes::WedgeCuts<Lane> row = lanes::uncut(sphere);
    row.distance = to_lane(-4.0);
    const Sphere cap = lanes::caps_of(sphere, row);
    EXPECT_NEAR(to_double(cap.radius), 3.0, 1e-4);
    EXPECT_EQ(to_double(cap.depth), 10.0) << "the row's plane is the horizon";
    EXPECT_EQ(to_double(cap.offset), 0.0);
    row.normal_depth = to_lane(0.5);
    EXPECT_NEAR(to_double(lanes::caps_of(sphere, row).depth), 12.0, 1e-4) << "towards the row";
    row.distance = to_lane(2.0);
    EXPECT_NEAR(to_double(lanes::caps_of(sphere, row).radius), 5.0, 1e-4) << "the centre is inside";
    EXPECT_EQ(to_double(lanes::caps_of(sphere, row).depth), 10.0);
    EXPECT_NEAR(to_double(lanes::caps_of(sphere, lanes::uncut(sphere)).radius), 5.0, 1e-4) << "nothing cuts";
}

// A tile's corner, 4 above and 4 beside the centre of a sphere of radius 5: it meets the column and the row, and not
// both.
TEST(Narrow, FindsNothingWhereASpherePassesByAtACorner) {
    const TileWedge column = {{{0.6, -0.8}, {0.6, -0.8}}};
    const Sphere sphere = sphere_around(0.0, 5.0, 5.0, 4.0);
    EXPECT_FALSE(cut_wedge(column, sphere).depths.empty()) << "4 away";
    lanes::WedgeCuts<Lane> row = lanes::uncut(sphere);
    row.distance = to_lane(-4.0);
    EXPECT_TRUE(cut_wedge(column, lanes::caps_of(sphere, row)).depths.empty()) << "4 away from a ball of radius 3";
    row.distance = to_lane(-2.9);
    EXPECT_FALSE(cut_wedge(column, lanes::caps_of(sphere, row)).depths.empty());
}

TEST(Narrow, TakesEveryMagnitude) {
    for (const double scale : {1e-8, 1.0, 1e16}) {
        const TileWedge wedge = detail::tile_wedge({500.0, 500.0, 1000}, 480, 511, 0.5);
        const WedgeCut inside = cut_wedge(wedge, 0.0, 2.0 * scale, scale);
        EXPECT_LE(inside.depths.low, scale);
        EXPECT_GE(inside.depths.high, 3.0 * scale);
        EXPECT_TRUE(cut_wedge(wedge, scale, 2.0 * scale, 0.5 * scale).depths.empty());
        const WedgeCut around = cut_wedge(wedge, scale, -2.0 * scale, 50.0 * scale);
        EXPECT_FALSE(around.depths.empty());
    }
}

} // namespace
} // namespace manylights::test
