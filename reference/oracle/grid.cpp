// Why no light is lost, with no slack at all. Rounding is monotone: a <= b gives fl(a) <= fl(b), and a sum of terms
// that are not negative is no less than any of them. So where ml_affects accepts a point, along each axis
//     fl(x * x) <= fl(squared distance) < fl(r * r)   with x = fl(p - c),   hence |x| < r, hence |p - c| < r
// in real numbers, whatever underflowed: had |p - c| been r or more, its rounding would not be below the float r. So p
// lies within [c - r, c + r]; the corners computed in double may round, but not past the double p; and a cell is found
// by steps that are monotone as well: an exact product with a power of two, and floor.

#include "reference/oracle/grid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace manylights::oracle {

namespace {

// Cells are numbered from -2^30 to 2^30 along each axis.
constexpr int kLargestCellExponent = 30;
constexpr double kLargestCell = 1073741824.0;

// The edge is above 2 and at most 4 ranges, so that a box touches at most two cells along each axis, unless the light
// is so far away that its cells would have no number; then it is as much longer as it takes.
int edge_exponent_of(const RelativeLight& light) {
    const double farthest = std::max({std::fabs(light.center.x), std::fabs(light.center.y), std::fabs(light.center.z)});
    int reach_exponent = 0; // the box lies within 2^reach_exponent of the origin
    std::frexp(farthest + light.range, &reach_exponent);
    return std::max(std::ilogb(light.range) + 2, reach_exponent - kLargestCellExponent);
}

bool is_finite(MlFloat3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

} // namespace

// A light that does not contain its own centre contains nothing: its squared range is zero, or its centre not finite.
LightGrid::LightGrid(const std::vector<RelativeLight>& lights) {
    std::map<int, std::vector<RelativeLight>> by_exponent;
    for (const RelativeLight& light : lights)
        if (ml_affects(light.center, light.center, light.range)) by_exponent[edge_exponent_of(light)].push_back(light);
    for (auto& [exponent, of_level] : by_exponent) levels_.emplace_back(exponent, std::move(of_level));
}

void LightGrid::append_affecting(MlFloat3 point, std::vector<std::uint32_t>& indices) const {
    if (!is_finite(point)) return; // in no light, as the rule says, and in no cell
    const auto before = static_cast<std::ptrdiff_t>(indices.size());
    for (const Level& level : levels_) level.append_affecting(point, indices);
    std::sort(indices.begin() + before, indices.end());
}

LightGrid::Level::Level(int edge_exponent, std::vector<RelativeLight> lights)
    : inverse_edge_(std::ldexp(1.0, -edge_exponent)), lights_(std::move(lights)) {
    file(add_cells());
}

LightGrid::Level::Box LightGrid::Level::box_of(const RelativeLight& light) const {
    const auto cell = [this](double coordinate) {
        return static_cast<std::int32_t>(std::floor(coordinate * inverse_edge_));
    };
    const Double3 center = to_double(light.center);
    const double range = light.range;
    return {{cell(center.x - range), cell(center.y - range), cell(center.z - range)},
            {cell(center.x + range), cell(center.y + range), cell(center.z + range)}};
}

// The cells of each light, one light after the other.
std::vector<std::uint32_t> LightGrid::Level::add_cells() {
    std::vector<std::uint32_t> cells;
    for (const RelativeLight& light : lights_) {
        const Box box = box_of(light);
        for (std::int32_t z = box.first.z; z <= box.last.z; ++z)
            for (std::int32_t y = box.first.y; y <= box.last.y; ++y)
                for (std::int32_t x = box.first.x; x <= box.last.x; ++x) cells.push_back(cells_.find_or_add({x, y, z}));
    }
    return cells;
}

// A counting sort of the lights by cell.
void LightGrid::Level::file(const std::vector<std::uint32_t>& cells) {
    first_.assign(std::size_t{cells_.cell_count()} + 1, 0);
    for (const std::uint32_t cell : cells) ++first_[cell + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    filings_.resize(cells.size());
    std::vector<std::uint64_t> next(first_.begin(), first_.end() - 1);
    auto cell = cells.begin();
    for (std::size_t light = 0; light < lights_.size(); ++light) {
        const int count = box_of(lights_[light]).cell_count();
        for (int i = 0; i < count; ++i) filings_[next[*cell++]++] = static_cast<std::uint32_t>(light);
    }
}

void LightGrid::Level::append_affecting(MlFloat3 point, std::vector<std::uint32_t>& indices) const {
    const double x = std::floor(point.x * inverse_edge_);
    const double y = std::floor(point.y * inverse_edge_);
    const double z = std::floor(point.z * inverse_edge_);
    if (std::max({std::fabs(x), std::fabs(y), std::fabs(z)}) > kLargestCell) return; // farther than any light of these
    const std::uint32_t cell =
        cells_.find({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), static_cast<std::int32_t>(z)});
    if (cell == CellTable::kNone) return;
    for (std::uint64_t i = first_[cell]; i < first_[cell + 1]; ++i) {
        const RelativeLight& light = lights_[filings_[i]];
        if (ml_affects(point, light.center, light.range)) indices.push_back(light.index);
    }
}

} // namespace manylights::oracle
