#include "src/build/narrow.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace manylights::detail {

namespace {

// What is nowhere, however much it is widened.
constexpr Interval kNone = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

// The half-space between a plane of this slope, offset = slope * depth, and greater (sign 1) or lesser (-1) slopes.
SidePlane plane_at(double slope, double sign) {
    const double length = std::sqrt(1.0 + slope * slope);
    return {sign / length, -sign * slope / length};
}

// Distance of a point from the plane, moved outwards by slack. The rest of the work is exact but for a few roundings
// with respect to the plane so moved, and slack is above what can be wrong about the plane itself: n is off by at most
// 2^-51 in length and the sum by 2^-51 * |c|, so for points p of the sphere n * p is off by less than
// 2^-50 * (|c| + r). 2^-46 leaves sixteen times that.
double slack_of(double offset, double depth, double radius) {
    return 0x1p-46 * (std::fabs(offset) + std::fabs(depth) + radius);
}

// The depths of the sphere inside the half-space, h being the distance of its centre c from the plane (positive
// inside) and n the plane's normal. The deepest point of the sphere is the pole c + r * e_depth, at a distance of
// h + r * n_depth. If it is inside, it is the answer. If it is not, the deepest point of sphere and half-space is on
// the plane, so on the disc that the plane cuts: its centre is c - h * n, its radius sqrt(r^2 - h^2), and along the
// disc the depth grows by sqrt(1 - n_depth^2) = |n_offset| per unit at most. The nearest point mirrors that. Both
// forms agree where the pole is on the plane, so the comparison's rounding does not matter.
//
// r^2 - h^2 is taken as (r - h) * (r + h), which loses no digits.
Interval half_space_depths(const SidePlane& n, double h, double depth, double radius) {
    if (h <= -radius) return kNone;
    const double reach = radius * n.depth;
    const bool far_pole = h + reach >= 0.0;
    const bool near_pole = h - reach >= 0.0;
    if (far_pole && near_pole) return {depth - radius, depth + radius};
    const double disc_depth = depth - h * n.depth;
    const double disc_reach = std::sqrt(std::max((radius - h) * (radius + h), 0.0)) * std::fabs(n.offset);
    return {near_pole ? depth - radius : disc_depth - disc_reach, far_pole ? depth + radius : disc_depth + disc_reach};
}

} // namespace

// A pixel p is asked for points that project within guard_px of p + 0.5; rounding widens that by as much as in
// pixel_bounds. So the tile's points project to [first + 0.5 - reach, last + 0.5 + reach].
TileWedge tile_wedge(const Axis& axis, std::uint32_t first_px, std::uint32_t last_px, double guard_px) {
    const double reach = guard_px + 0.05 + 1e-5 * axis.size;
    const double a = (first_px + 0.5 - reach - axis.origin) / axis.scale;
    const double b = (last_px + 0.5 + reach - axis.origin) / axis.scale;
    return {{plane_at(std::min(a, b), 1.0), plane_at(std::max(a, b), -1.0)}};
}

WedgeCut cut_wedge(const TileWedge& wedge, double offset, double depth, double radius) {
    const double slack = slack_of(offset, depth, radius);
    WedgeCut cut = {{depth - radius, depth + radius}, 0.0, 0.0};
    double distances[2];
    for (int i = 0; i < 2; ++i) {
        const SidePlane& side = wedge.sides[i];
        distances[i] = side.offset * offset + side.depth * depth + slack;
        const Interval depths = half_space_depths(side, distances[i], depth, radius);
        cut.depths.low = std::max(cut.depths.low, depths.low);
        cut.depths.high = std::min(cut.depths.high, depths.high);
    }
    // The result's own rounding.
    cut.depths.low -= slack;
    cut.depths.high += slack;
    const int worst = distances[0] <= distances[1] ? 0 : 1;
    cut.distance = distances[worst];
    cut.normal_depth = wedge.sides[worst].depth;
    return cut;
}

// Two half-spaces with normals m and n, at distances h and k from the centre c (positive inside), g = m * n. Of a
// column and a row only the depth components meet in g. The point of both half-spaces that is nearest to c is
// c + a * m + b * n with a, b >= 0 (Karush, Kuhn, Tucker), and lies on their common edge where a and b are both
// positive: there h + a + g * b = 0 and k + g * a + b = 0, so a * (1 - g^2) = g * k - h and b * (1 - g^2) = g * h - k.
// Then its squared distance is -(a * h + b * k) = (h^2 + k^2 - 2 * g * h * k) / (1 - g^2), and the sphere misses the
// tile where that is r^2 or more.
//
// h and k are of planes that were moved outwards. Conservative: each of the terms is off by less than 2^-49 of
// h^2 + k^2 + r^2, and what a wrong sign of a or b may change is the square of such a rounding; the last term is 2^9
// times that. It also decides against rejection where m and n are nearly parallel.
bool misses_corner(const WedgeCut& column, const WedgeCut& row, double radius) {
    const double g = column.normal_depth * row.normal_depth;
    const double h = column.distance;
    const double k = row.distance;
    if (!(g * k > h && g * h > k)) return false;
    const double squares = h * h + k * k;
    const double squared_radius = radius * radius;
    const double excess = squares - 2.0 * g * h * k - squared_radius * (1.0 - g * g);
    return excess > 0x1p-40 * (squares + squared_radius);
}

} // namespace manylights::detail
