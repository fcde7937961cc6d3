// Shading by an octree: each point tests the lights of the nodes from the root to its froxel.
#include "lab/techniques/shading_pass.glsl"
#define FROXEL_BINDING 6
#define OCTREE_BINDING 7
#include "lab/techniques/octree/octree.glsl"

layout(std430, set = 0, binding = 9) readonly buffer Lists { MlCell d[]; } lists; // of nodes
layout(std430, set = 0, binding = 10) readonly buffer References { uint d[]; } references;

// Units of 16 bytes: two lists, or the numbers of children of four nodes. Both kinds are numbered in turn, so that none
// is taken for the other.
void read_unit(inout Pixel pixel, uint unit) {
    touch_node(unit);
#if defined(MANYLIGHTS_RECORD)
    pixel.record.nodes += 1u;
#endif
}

void walk_list(inout Pixel pixel, uint node) {
    read_unit(pixel, node & ~1u);
    MlCell list = lists.d[node];
    for (uint i = list.first; i < list.first + list.count; i += 1u) {
        uint light = references.d[i];
        touch_light(light);
        vec4 sphere = spheres.d[light];
        if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
    }
#if defined(MANYLIGHTS_RECORD)
    pixel.record.tested += list.count;
    pixel.record.references += list.count;
#endif
}

void walk_path(inout Pixel pixel) {
    uvec3 at = uvec3(tile_of(froxels.tiles, pixel.coordinates), slice_of(pixel.depth));
    uint node = root_node();
    walk_list(pixel, node);
    for (uint level = root_level(); level > 0u; level -= 1u) {
        if (octree.is_sparse != 0u) read_unit(pixel, (node / 2u) | 1u);
        node = child_of(node, level - 1u, at >> (level - 1u));
        walk_list(pixel, node);
    }
}

void main() {
    Pixel pixel = begin_pixel(true);
    if (pixel.is_shaded) walk_path(pixel);
    end_pixel(pixel);
}
