#include "reference/paper/tight.h"

#include <algorithm>
#include <cmath>

namespace manylights::paper {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The pixels of tile t are [t * tile_px, end), end being cut by the image's; a pixel p is promised for what projects to
// [p + 0.5 - guard - e, p + 0.5 + guard + e], e the widening as in bounds.cpp.
void fill_wedges(FlatArray<Wedge>& wedges, std::uint32_t tiles, std::uint32_t tile_px, std::uint32_t size, double scale,
                 double center, double reach) {
    Wedge* out = wedges.require(tiles);
    for (std::uint32_t t = 0; t < tiles; ++t) {
        const std::uint32_t first = t * tile_px, last = std::min(first + tile_px, size) - 1;
        out[t] = {(first + 0.5 - reach - center) / scale, (last + 0.5 + reach - center) / scale};
    }
}

// What double arithmetic may get wrong about a sphere: sums of a few products of its coordinates, 2^-50 of their size.
double slack_of(const CulledLight& light) {
    return 0x1p-46 * (std::abs(double(light.x)) + std::abs(double(light.y)) + std::abs(double(light.depth)) +
                      double(light.radius));
}

// The depths at which one pair of pieces is within the radius of the centre. With p = (c, x, y), the centre by depth
// and sides, and n = (1, s, t), the pieces' slopes, the squared distance from c at depth d is
//     (d - c)^2 + (s d - x)^2 + (t d - y)^2 = |d n - p|^2
// and at most R^2 between d = (n p -+ sqrt(|n|^2 R^2 - |n x p|^2)) / |n|^2. The cross product is taken as it stands,
// for |n|^2 |p|^2 - (n p)^2 cancels. Inside a wedge slope and side are zero, so the axis drops out.
//
// Conservative: R = radius + slack, and |n x p| is off by less than 2^-50 |n| |p|. Where the depths are not none
// |n x p| <= |n| R, so its square is off by less than |n|^2 times 2^-49 R |p| + 2^-100 |p|^2, which is less than what
// the slack adds to R^2.
DepthInterval depths_within(const WedgePieces::Piece& column, const WedgePieces::Piece& row, double depth,
                            double radius) {
    const double s = column.slope, t = row.slope, x = column.side, y = row.side;
    const double cross_x = x - s * depth, cross_y = y - t * depth, cross_depth = s * y - t * x;
    const double length_squared = 1.0 + s * s + t * t;
    const double square =
        length_squared * (radius * radius) - (cross_x * cross_x + cross_y * cross_y + cross_depth * cross_depth);
    if (!(square >= 0.0)) return {kInfinity, -kInfinity};
    const double middle = depth + s * x + t * y, half = std::sqrt(square);
    return {(middle - half) / length_squared, (middle + half) / length_squared};
}

} // namespace

// Mirrored so that side >= 0. Then with growing depth the point, which is where its axis is cut by a plane of that
// depth, first is beyond the wedge's high slope, until high * depth = side; then inside; and from low * depth = side on
// short of its low slope. With high <= 0 it stays beyond, with low <= 0 it is never short.
WedgePieces wedge_pieces(const Wedge& wedge, double side) {
    const bool mirrored = side < 0.0;
    const double sign = mirrored ? -1.0 : 1.0, distance = sign * side;
    const double low = mirrored ? -wedge.high : wedge.low, high = mirrored ? -wedge.low : wedge.high;
    const double enters = high > 0.0 ? distance / high : kInfinity;
    const double leaves = low > 0.0 ? distance / low : kInfinity;
    return {{{sign * high, side, enters}, {0.0, 0.0, leaves}, {sign * low, side, kInfinity}}};
}

// Sphere and pyramid are convex, so what they share has one interval of depths, and each depth in it is met: a slice
// meets both together exactly where it meets the interval. So no slice needs a test of its own. The interval is the
// hull of those of the pieces of both axes, at most five.
//
// A piece's end is rounded, so the form of its neighbour may be used 2^-51 too far. There both forms differ by the
// square of that, relative to the centre's coordinates: the slack is above it.
DepthInterval meeting_depths(const WedgePieces& column, const WedgePieces& row, const CulledLight& light,
                             float near_depth) {
    const double slack = slack_of(light), depth = light.depth, radius = light.radius + slack;
    const double last = depth + radius;
    double begin = std::max(depth - radius, double(near_depth));
    DepthInterval hull{kInfinity, -kInfinity};
    for (std::uint32_t i = 0, j = 0; begin <= last;) {
        const WedgePieces::Piece &of_column = column.pieces[i], &of_row = row.pieces[j];
        const double end = std::min(of_column.end, of_row.end);
        if (begin <= end) {
            const DepthInterval within = depths_within(of_column, of_row, depth, radius);
            const double low = std::max(within.low, begin), high = std::min({within.high, end, last});
            if (low <= high) hull = {std::min(hull.low, low), std::max(hull.high, high)};
        }
        if (end >= last) break;
        begin = std::max(begin, end);
        i += of_column.end == end;
        j += of_row.end == end;
    }
    return {hull.low - slack, hull.high + slack}; // the result's own rounding
}

void TightTest::set_view(const Camera& camera, const Grid& grid) {
    const double reach = double(camera.guard_px) + double(grid.widening_px);
    near_depth_ = camera.near_depth;
    tiles_x_ = grid.tiles_x;
    tiles_y_ = grid.tiles_y;
    fill_wedges(columns_, tiles_x_, grid.tile_px, camera.width, camera.scale_x, camera.center_x, reach);
    fill_wedges(rows_, tiles_y_, grid.tile_px, camera.height, camera.scale_y, camera.center_y, reach);
}

// Slices are kept within the box's: both are supersets of what is needed, so what they share is one, too.
std::uint64_t TightTest::write_scatter(const CulledLight& light, const CellBox& box, const SliceTable& slices,
                                       std::uint32_t place, Scatter* scatter) {
    const std::uint32_t tiles = tiles_x_ * tiles_y_, tile = box.first_cell % tiles;
    const std::uint32_t first_slice = box.first_cell / tiles, last_slice = first_slice + box.slices - 1;
    const std::uint32_t left = tile % tiles_x_, top = tile / tiles_x_;
    WedgePieces* columns = column_pieces_.require(box.columns);
    for (std::uint32_t x = 0; x < box.columns; ++x) columns[x] = wedge_pieces(column(left + x), light.x);
    const Scatter* const begin = scatter;
    for (std::uint32_t y = 0; y < box.rows; ++y) {
        const WedgePieces pieces = wedge_pieces(row(top + y), light.y);
        for (std::uint32_t x = 0; x < box.columns; ++x) {
            const DepthInterval depths = meeting_depths(columns[x], pieces, light, near_depth_);
            if (depths.is_empty()) continue;
            const float low = float(depths.low), high = float(depths.high);
            const std::uint32_t s0 = std::max(slices.slice_of(low - kDepthSlack * std::abs(low)), first_slice);
            const std::uint32_t s1 = std::min(slices.slice_of(high + kDepthSlack * std::abs(high)), last_slice);
            for (std::uint32_t s = s0; s <= s1; ++s) *scatter++ = {s * tiles + tile + y * tiles_x_ + x, place};
        }
    }
    return std::uint64_t(scatter - begin);
}

} // namespace manylights::paper
