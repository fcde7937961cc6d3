// Froxels, tile by tile and from near to far within each: froxel_grid.h makes the buffer. The includer brings
// FROXEL_BINDING, the buffer's binding.
#ifndef MANYLIGHTS_LAB_FROXEL_GRID_GLSL
#define MANYLIGHTS_LAB_FROXEL_GRID_GLSL

#include "lab/techniques/device/sphere_bounds.h"
#include "lab/techniques/device/tile_grid.glsl"

layout(std430, set = 0, binding = FROXEL_BINDING) readonly buffer FroxelGrid {
    TileGrid tiles;
    uint slice_count;
    float edges[]; // of slices, one more than there are
}
froxels;

#define SLICE_EDGE(i) froxels.edges[i]
#include "lab/techniques/device/depth_slices.glsl"

uint slice_of(float depth) { return slice_of(depth, froxels.slice_count); }

// First and last. Not of empty spans.
uvec2 slices_of(DepthSpan depths) { return uvec2(slice_of(depths.low), slice_of(depths.high)); }

uint froxel_index(uvec2 tile, uint slice) { return tile_index(froxels.tiles, tile) * froxels.slice_count + slice; }

// Of a point.
uint froxel_of(uvec2 pixel, float depth) { return froxel_index(tile_of(froxels.tiles, pixel), slice_of(depth)); }

#endif
