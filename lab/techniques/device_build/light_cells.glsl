// The cells that a light in view goes to, tiles under its pixels and slices of its sphere's depths. The includer brings
// SLICE_EDGE(i), and push constants `grid` and `slice_count`.
#ifndef MANYLIGHTS_LAB_LIGHT_CELLS_GLSL
#define MANYLIGHTS_LAB_LIGHT_CELLS_GLSL

#include "lab/techniques/device/depth_slices.glsl"
#include "lab/techniques/device/tile_grid.glsl"
#include "lab/techniques/device/visible_light.glsl"

// Tiles across, tiles down, slices.
struct CellBox {
    uvec3 first, size;
};

// The depths need no slack beside the culling radius: tile_lists.glsl.
CellBox cells_of(VisibleLight light) {
    uint first_slice = slice_of(light.sphere.z - light.sphere.w, slice_count);
    uint last_slice = slice_of(light.sphere.z + light.sphere.w, slice_count);
    CellBox box;
    box.first = uvec3(tile_of(grid, first_pixel(light)), first_slice);
    box.size = uvec3(tile_of(grid, last_pixel(light)), last_slice) - box.first + 1u;
    return box;
}

// The cell of that number in the box.
uint cell_in(CellBox box, uint i) {
    uvec3 cell = box.first + uvec3(i % box.size.x, i / box.size.x % box.size.y, i / (box.size.x * box.size.y));
    return (cell.z * grid.tiles.y + cell.y) * grid.tiles.x + cell.x;
}

#endif
