#include "src/build/narrow.h"

#include <algorithm>
#include <cmath>

namespace manylights::detail {

namespace {

// The half-space between a plane of this slope, offset = slope * depth, and greater (sign 1) or lesser (-1) slopes.
SidePlane plane_at(double slope, double sign) {
    const double length = std::sqrt(1.0 + slope * slope);
    return {sign / length, -sign * slope / length};
}

} // namespace

// A pixel p is asked for points that project within guard_px of p + 0.5; rounding widens that by as much as in
// pixel_bounds. So the tile's points project to [first + 0.5 - reach, last + 0.5 + reach].
TileWedge tile_wedge(const Axis& axis, std::uint32_t first_px, std::uint32_t last_px, double guard_px) {
    const double reach = guard_reach(axis, guard_px);
    const double a = (first_px + 0.5 - reach - axis.origin) / axis.scale;
    const double b = (last_px + 0.5 + reach - axis.origin) / axis.scale;
    return {{plane_at(std::min(a, b), 1.0), plane_at(std::max(a, b), -1.0)}};
}

} // namespace manylights::detail
