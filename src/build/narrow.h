#pragma once
// The narrowed depth range: the depths at which a sphere reaches into the pyramid of a tile. A light's whole range is
// loose for all tiles but the one that it is in front of. Here are the pyramid's planes; narrow-inl.h cuts spheres.

#include "src/build/bounds.h"
#include "src/build/camera.h"

#include <cstdint>

namespace manylights::detail {

// A plane through the camera and along one image axis, and the half-space on its inner side: the points whose offset
// along the view axis and whose depth give offset * p.offset + depth * p.depth >= 0. The normal has the length 1.
struct SidePlane {
    double offset, depth;
};

// A column or a row of tiles: what the two planes hold between them. The first one is the side of lesser slopes.
struct TileWedge {
    SidePlane sides[2];
};

// Holds every point that a pixel in [first_px, last_px] of the axis is promised for: see pixel_bounds.
TileWedge tile_wedge(const Axis& axis, std::uint32_t first_px, std::uint32_t last_px, double guard_px);

} // namespace manylights::detail
