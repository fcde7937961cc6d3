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

// What a row of tiles holds of spheres, as spheres again, for the row's columns to cut. A sphere whose centre is
// outside of a plane, at the distance h < 0, has only a cap inside that is less than half of it, and the ball around
// the cap's disc holds the cap: its centre is c - h * n, its radius sqrt(r^2 - h^2). So at the row's outer tiles the
// columns cut a smaller ball, which is nearer to the row as well; and a ball that passes by at a tile's corner meets no
// column there. Of the centre's coordinates, n changes the depth and the one along the column, which columns do not ask
// for.
//
// h is of the plane that was moved outwards already. The ball's depth is off by 4u * r + u * |depth|, its radius by
// 3u * r: 8u * s are added to the radius. Where no side was violated, h counts as 0 and the ball is the sphere.
template <class V>
HWY_INLINE WedgeSpheres<V> caps_of(const WedgeSpheres<V>& along_columns, const WedgeCuts<V>& row) {
    const hwy::HWY_NAMESPACE::DFromV<V> d;
    using namespace hwy::HWY_NAMESPACE;
    const WedgeSpheres<V>& s = along_columns;
    const V zero = Zero(d);
    const V h = Min(row.distance, zero);
    const V disc = Sqrt(Max((s.radius - h) * (s.radius + h), zero));
    return {s.offset, s.depth - h * row.normal_depth, disc + s.slack * Set(d, 0.5f), s.slack};
}

// Depths of a tile, from those of its column, which cuts the caps, and its row. 32u * s: 8u for the results' own
// roundings, 17u for the 2^-20 that a caller's depth may be off (|depth| <= s), and two more for this subtraction
// itself.
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
