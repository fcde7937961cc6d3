#pragma once
// From sphere to grid box: the rectangle of tiles after Mara and McGuire, 2D Polyhedral Bounds of a Clipped,
// Perspective-Projected 3D Sphere, JCGT 2013, as TLT section 4.1 uses it, and the slices of the depth range.

#include "reference/paper/cull.h"
#include "reference/paper/slices.h"

namespace manylights::paper {

/// Positions of one image axis in tiles: slope * scale + center, over what is beyond reach on either side.
struct TileAxis {
    float scale, first_center, last_center;
    std::uint32_t tiles;
};

struct Grid {
    std::uint32_t tile_px;
    float widening_px; ///< tiles are widened by this much, beyond guard_px
    TileAxis x, y;
};

Grid make_grid(const Camera& camera, std::uint32_t tile_px);

/// A light's box of cells and its depth range, widened outward.
struct BoundedLight {
    std::uint32_t first_cell; ///< cells count tile x fastest, then tile y, then slice
    std::uint16_t columns, rows;
    std::uint32_t slices;
    std::uint32_t index;
    float min_depth, max_depth;

    std::uint64_t cell_count() const { return std::uint64_t{slices} * rows * columns; }
};

/// True: `bounded` holds the light's box; false: it touches no tile.
bool bound(const Camera& camera, const Grid& grid, const SliceTable& slices, const CulledLight& light,
           BoundedLight& bounded);

} // namespace manylights::paper
