#pragma once
// Points where tiles and slices meet: the places at which a culling structure that rounds loses lights.

#include "tests/property/promise.h"

namespace manylights::test {

/// Where grids have their edges; the same for all structures with slices of the view.
struct Grid {
    std::uint32_t tile_px;
    std::vector<float> slice_edges; ///< the finite ones above 0
};

Grid grid_of(const ManylightsSettings& settings, const ManylightsView& view);

struct EdgePoint {
    MlFloat3 point;                  ///< camera-relative
    std::vector<float> query_depths; ///< further depths at which to ask, beside those that follow from the point
};

/// Anywhere in the image, at the offset from a pixel's centre that guard_px allows at most.
EdgePoint point_anywhere(oracle::Random& random, const oracle::Camera& camera);
/// Where a pixel beside a tile's edge is only just promised.
EdgePoint point_at_tile_edge(oracle::Random& random, const oracle::Camera& camera, const Grid& grid);
/// With a view depth of a slice's edge, and asked for there.
EdgePoint point_at_slice_edge(oracle::Random& random, const oracle::Camera& camera, const Grid& grid);

/// The point really lies within 4 units in the last place of a tile's edge (moved out by what guard_px promises), or of
/// a slice's edge.
bool is_at_edge(const oracle::Camera& camera, const Grid& grid, MlFloat3 point);

} // namespace manylights::test
