// The narrowed depth range in floats, for a vector of spheres: included once per instruction set, see lanes.h. narrow.h
// says what it is.
#if defined(MANYLIGHTS_NARROW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANYLIGHTS_NARROW_INL_H
#undef MANYLIGHTS_NARROW_INL_H
#else
#define MANYLIGHTS_NARROW_INL_H
#endif

#include <hwy/highway.h>

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {

// Spheres, by what matters along one axis of the image, and the slack of all that follows.
template <class V>
struct WedgeSpheres {
    V offset, depth, radius, slack;
};

// The depths that spheres may have inside of a wedge, and the side that their centres violate most.
template <class V>
struct WedgeCuts {
    V low, high;    // low > high: they do not meet
    V distance;     // of the centre from that side, positive inside
    V normal_depth; // of that side
};

// u = 2^-24 is a float's rounding, s = |x| + |y| + |depth| + r with x and y along both axes. Spheres with s outside of
// [1e-9, 4e18] are not narrowed: squares would leave the range of floats. (The part of the radius that is made for
// rounding is 1e-6 s at least, so what underflows below 1e-38 under the square root is 1e-19 < 1e-6 s.)
//
// slack = 16u * s. A plane's distance from the centre is off by 3u * (|offset| + |depth|) with the rounding of its
// normal n, its products and their sum; n turns the sphere's other points by u * r more; the length of n is off by u,
// which scales distances up to r; adding the slack rounds once. Together less than 6u * s. So the plane at
// distance + slack is outside of the true one for every point of the sphere; from there on it is the plane.
template <class V>
HWY_INLINE V narrow_slack(V x, V y, V depth, V radius) {
    const hwy::HWY_NAMESPACE::DFromV<V> d;
    using namespace hwy::HWY_NAMESPACE;
    return (Abs(x) + Abs(y) + Abs(depth) + radius) * Set(d, 0x1p-20f);
}

template <class V>
HWY_INLINE WedgeCuts<V> uncut(const WedgeSpheres<V>& s) {
    const hwy::HWY_NAMESPACE::DFromV<V> d;
    using namespace hwy::HWY_NAMESPACE;
    return {s.depth - s.radius, s.depth + s.radius, Set(d, std::numeric_limits<float>::infinity()), Zero(d)};
}

// The depths of the spheres inside the half-space, h being the distance of the centre c from its plane (positive
// inside) and n the plane's normal. The deepest point of a sphere is the pole c + r * e_depth, at a distance of h + r *
// n_depth. If it is inside, it is the answer. If it is not, the deepest point of sphere and half-space is on the plane,
// so on the disc that the plane cuts: its centre is c - h * n, its radius sqrt(r^2 - h^2), and along the disc the depth
// grows by sqrt(1 - n_depth^2) = |n_offset| per unit at most. The nearest point mirrors that. Both forms meet where the
// pole is on the plane, and smoothly, so the comparison's rounding does not matter.
//
// r^2 - h^2 is taken as (r - h) * (r + h), which loses no digits. Where there is a disc, |h| < r: its depths are off by
// 5u * r + 3u * (|depth| + r), less than finish_depths adds.
template <class V>
HWY_INLINE void cut_side(const WedgeSpheres<V>& s, V normal_offset, V normal_depth, WedgeCuts<V>& cuts) {
    const hwy::HWY_NAMESPACE::DFromV<V> d;
    using namespace hwy::HWY_NAMESPACE;
    const V zero = Zero(d);
    const V h = normal_offset * s.offset + normal_depth * s.depth + s.slack;
    const V reach = s.radius * normal_depth;
    const V disc_depth = s.depth - h * normal_depth;
    const V disc_reach = Sqrt(Max((s.radius - h) * (s.radius + h), zero)) * Abs(normal_offset);
    const V low = IfThenElse(h - reach >= zero, s.depth - s.radius, disc_depth - disc_reach);
    const V high = IfThenElse(h + reach >= zero, s.depth + s.radius, disc_depth + disc_reach);
    const auto misses = h <= Neg(s.radius);
    cuts.low = Max(cuts.low, IfThenElse(misses, Set(d, std::numeric_limits<float>::infinity()), low));
    cuts.high = Min(cuts.high, high);
    const auto worse = h < cuts.distance;
    cuts.distance = IfThenElse(worse, h, cuts.distance);
    cuts.normal_depth = IfThenElse(worse, normal_depth, cuts.normal_depth);
}

// A tile is what its column and its row have in common. Does a sphere miss it although it meets both? Then it passes by
// at the tile's corner.
//
// Two half-spaces with normals m and n, at distances h and k from the centre c (positive inside), g = m * n. Of a
// column and a row only the depth components meet in g. The point of both half-spaces that is nearest to c is
// c + a * m + b * n with a, b >= 0 (Karush, Kuhn, Tucker), and lies on their common edge where a and b are both
// positive: there h + a + g * b = 0 and k + g * a + b = 0, so a * (1 - g^2) = g * k - h and b * (1 - g^2) = g * h - k.
// Then its squared distance is -(a * h + b * k) = (h^2 + k^2 - 2 * g * h * k) / (1 - g^2), and the sphere misses the
// tile where that is r^2 or more.
//
// h and k are of planes that were moved outwards already. Conservative: g is off by 5u, each of the terms by 12u of
// h^2 + k^2 + r^2 with it, and what a wrong sign of a or b may change is the square of such a rounding; the last term
// is 64u. It also decides against rejection where m and n are nearly parallel. Where a side was not cut, its distance
// is +inf and the first comparison is false or meets NaN, which is false as well.
template <class V>
HWY_INLINE auto misses_corner(const WedgeCuts<V>& column, const WedgeCuts<V>& row, V radius) {
    const hwy::HWY_NAMESPACE::DFromV<V> d;
    using namespace hwy::HWY_NAMESPACE;
    const V g = column.normal_depth * row.normal_depth;
    const V h = column.distance;
    const V k = row.distance;
    const V squares = h * h + k * k;
    const V squared_radius = radius * radius;
    const V excess = squares - (g + g) * h * k - squared_radius * (Set(d, 1.0f) - g * g);
    const auto on_edge = And(g * k > h, g * h > k);
    return And(on_edge, excess > Set(d, 0x1p-18f) * (squares + squared_radius));
}

// Depths of a tile, from those of its column and its row. 32u * s: 8u for the results' own roundings, 17u for the
// 2^-20 that a caller's depth may be off (|depth| <= s), and two more for this subtraction itself.
template <class V>
HWY_INLINE V finish_low(V column, V row, V slack) {
    return hwy::HWY_NAMESPACE::Max(column, row) - (slack + slack);
}
template <class V>
HWY_INLINE V finish_high(V column, V row, V slack) {
    return hwy::HWY_NAMESPACE::Min(column, row) + (slack + slack);
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
