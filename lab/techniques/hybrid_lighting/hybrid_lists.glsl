// Which lights go to the lists of which froxels: those whose sphere, within the tile, has depths of the froxel's slice.
#if defined(MANYLIGHTS_LINKED)
#include "lab/techniques/device/tile_links.glsl"
#define OWN_BINDING 4
#else
#include "lab/techniques/device/tile_lists.glsl"
#define OWN_BINDING 3
#endif
#include "lab/techniques/hybrid_lighting/coverage.glsl"

#define FROXEL_BINDING OWN_BINDING
#include "lab/techniques/device/froxel_grid.glsl"

layout(constant_id = 1) const uint only_occupied = 0u;
layout(std430, set = 0, binding = OWN_BINDING + 1) readonly buffer Occupied { uint d[]; } occupied; // a bit per froxel

bool is_wanted(uint froxel) {
    return only_occupied == 0u || (occupied.d[froxel / 32u] >> (froxel & 31u) & 1u) != 0u;
}

void visit(VisibleLight light, uvec2 tile) {
    DepthSpan depths = covered_depths(light, tile);
    if (depths.low > depths.high) return;
    uvec2 slices = slices_of(depths);
    for (uint slice = slices.x; slice <= slices.y; ++slice) {
        uint froxel = froxel_index(tile, slice);
        if (is_wanted(froxel)) add_light(froxel, light.index);
    }
}
