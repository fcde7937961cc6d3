#pragma once
// The narrowed depth range: the depths at which a sphere reaches into the pyramid of a tile. A light's whole range is
// loose for all tiles but the one that it is in front of.

#include "src/build/bounds.h"
#include "src/build/camera.h"

#include <cstdint>

namespace manylights::detail {

// A plane through the camera and along one image axis, and the half-space on its inner side: the points whose offset
// along the view axis and whose depth give offset * p.offset + depth * p.depth >= 0. The normal has the length 1.
struct SidePlane {
    double offset, depth;
};

// A column or a row of tiles: what the two planes hold between them.
struct TileWedge {
    SidePlane sides[2];
};

// Holds every point that a pixel in [first_px, last_px] of the axis is promised for: see pixel_bounds.
TileWedge tile_wedge(const Axis& axis, std::uint32_t first_px, std::uint32_t last_px, double guard_px);

// A sphere and a wedge: the depths at which they may meet, and the side that the centre violates most.
struct WedgeCut {
    Interval depths; // empty: they do not meet
    double distance; // of the centre from that side, positive inside
    double normal_depth;
};

// A superset always. offset and depth: of the centre, along the wedge's axis.
WedgeCut cut_wedge(const TileWedge& wedge, double offset, double depth, double radius);

// A tile is what its column and its row have in common. Does the sphere miss it although it meets both? Then it passes
// by at the tile's corner. False wherever that is not certain.
bool misses_corner(const WedgeCut& column, const WedgeCut& row, double radius);

} // namespace manylights::detail
