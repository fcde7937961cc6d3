#pragma once
// From sphere to grid box: the rectangle of tiles after Mara and McGuire, 2D Polyhedral Bounds of a Clipped,
// Perspective-Projected 3D Sphere, JCGT 2013, as TLT section 4.1 uses it, and the slices of the depth range.

#include "reference/paper/cull.h"
#include "reference/paper/slices.h"

namespace manylights::paper {

/// The promise allows the query's depth 2^-20 relative; a quarter more covers the rounding of the range's ends.
constexpr float kDepthSlack = 1.25f * 0x1p-20f;

struct Grid {
    std::uint32_t tile_px, tiles_x, tiles_y;
    float widening_px; ///< tiles are widened by this much, beyond guard_px

    /// Of a rectangle's left, top, right and bottom side: slope * scale + offset is its tile, that of the right and the
    /// bottom side one further; clamped to [0, end].
    float scale[4], offset[4], end[4];
};

Grid make_grid(const Camera& camera, std::uint32_t tile_px);

/// A light's box of cells.
struct CellBox {
    std::uint32_t first_cell; ///< cells count tile x fastest, then tile y, then slice
    std::uint16_t columns, rows;
    std::uint32_t slices;

    std::uint64_t cell_count() const { return std::uint64_t{slices} * rows * columns; }
};

/// What the cells hold of a light; apart from the box, since each is read without the other.
struct CellLight {
    float min_depth, max_depth; ///< widened outward
    std::uint32_t index;
};

/// True: the light's box and what its cells hold; false: it touches no tile.
bool bound(const Camera& camera, const Grid& grid, const SliceTable& slices, const CulledLight& light, CellBox& box,
           CellLight& cell_light);

} // namespace manylights::paper
