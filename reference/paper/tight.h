#pragma once
// The tight cell test: a light goes to a cell only where its sphere may meet the part of the tile's pyramid between the
// slice's depths. The box of bounds.h has whole tiles of the sphere's rectangle, each with all of the sphere's slices.

#include "reference/paper/bin.h"

namespace manylights::paper {

/// side / depth of the points that the pixels of a column or a row of tiles are promised for.
struct Wedge {
    double low, high;
};

/// Depths, from low to high; none where low > high.
struct DepthInterval {
    double low, high;
    bool is_empty() const { return low > high; }
};

/// How far a point at (side, depth) with a fixed side and growing depth is from a wedge: three pieces, each ending
/// where the next begins; behind the last is nothing.
struct WedgePieces {
    /// Distance |slope * depth - side|; both zero where the piece is inside the wedge.
    struct Piece {
        double slope, side, end;
    };
    Piece pieces[3];
};

WedgePieces wedge_pieces(const Wedge& wedge, double side);

/// The depths, not nearer than near_depth, at which the sphere meets the pyramid of a column and a row. A superset, by
/// roundings only.
DepthInterval meeting_depths(const WedgePieces& column, const WedgePieces& row, const CulledLight& light,
                             float near_depth);

/// The test for the lights of one view.
class TightTest {
  public:
    void set_view(const Camera& camera, const Grid& grid);

    /// Lists the references of one light as write_scatter does, in those cells of its box that it passes; returns how
    /// many. scatter has room for the whole box.
    std::uint64_t write_scatter(const CulledLight& light, const CellBox& box, const SliceTable& slices,
                                std::uint32_t place, Scatter* scatter);

    const Wedge& column(std::uint32_t i) const { return columns_.data()[i]; }
    const Wedge& row(std::uint32_t i) const { return rows_.data()[i]; }

  private:
    float near_depth_ = 0.0f;
    std::uint32_t tiles_x_ = 0, tiles_y_ = 0;
    FlatArray<Wedge> columns_, rows_;
    FlatArray<WedgePieces> column_pieces_; ///< of one light's columns
};

} // namespace manylights::paper
