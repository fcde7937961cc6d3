// Where in the octree a light is stored: in the froxels with samples that it may reach, or in a node above them where it
// reaches all of the node's froxels. The includer brings the view, VisibleLight, and the buffers of tile_lists.glsl.
#ifndef MANYLIGHTS_LAB_OCTREE_PLACE_GLSL
#define MANYLIGHTS_LAB_OCTREE_PLACE_GLSL

#define FROXEL_BINDING 3
#define OCTREE_BINDING 4
#include "lab/techniques/octree/octree.glsl"
#include "lab/techniques/octree/octree_corner.glsl"

layout(constant_id = 0) const uint kHasInner = 1u;
layout(constant_id = 1) const uint kHasCornerTable = 1u;
layout(std430, set = 0, binding = 6) readonly buffer Corners { vec4 d[]; } corners;

// Froxels of a node that are in the grid: first and last.
struct Block {
    uvec3 first, last;
};

Block block_of(uint level, uvec3 at) {
    Block block;
    block.first = at << level;
    block.last = min((at + 1u) << level, uvec3(froxels.tiles.tiles, froxels.slice_count)) - 1u;
    return block;
}

vec3 corner_at(uvec3 vertex) {
    return kHasCornerTable != 0u ? corners.d[corner_index(vertex)].xyz : computed_corner(vertex);
}

// A single froxel along an axis has no inner vertex, and either of its two will do: touching it is enough. The plane
// behind the last slice is nowhere.
uvec3 nearer_vertex(vec4 sphere, uvec3 froxel) {
    vec3 low = corner_at(froxel), high = corner_at(froxel + uvec3(1u, 1u, 0u));
    vec2 middle = 0.5 * (low.xy + high.xy);
    uvec2 beyond = uvec2(greaterThan(sphere.xy * low.z, middle * sphere.z));
    float end = froxels.edges[froxel.z + 1u];
    uint behind = froxel.z + 1u < froxels.slice_count && sphere.z > 0.5 * (low.z + end) ? 1u : 0u;
    return froxel + uvec3(beyond, behind);
}

// Whether the sphere has all innermost corners of the outermost froxels (Lamecki, Kaczmarek, Porter-Sobieraj, section
// III). Then it has the hull of these corners, and every froxel touches that hull: the light belongs into the lists of
// all of them. A light is never lost by it, for a node's list is read by all points of its froxels. The radius is a
// little smaller, so that rounding does not store a light above froxels that it would not be stored in.
bool reaches_all(vec4 sphere, Block block) {
    uvec3 low = block.first + 1u, high = block.last;
    bvec3 is_single = equal(block.first, block.last);
    if (any(is_single)) {
        uvec3 nearer = nearer_vertex(sphere, block.first);
        low = mix(low, nearer, is_single);
        high = mix(high, nearer, is_single);
    }
    float reach = sphere.w * (1.0 - 1e-5);
    for (uint i = 0u; i < 8u; ++i) {
        uvec3 side = uvec3(i, i >> 1u, i >> 2u) & 1u;
        vec3 offset = corner_at(low + side * (high - low)) - sphere.xyz;
        if (!(dot(offset, offset) <= reach * reach)) return false;
    }
    return true;
}

// Of a node that the light reaches: whether it is stored there, and nothing below need be looked at.
bool is_stored_at(VisibleLight light, uint level, Block block) {
    return level == 0u || (kHasInner != 0u && reaches_all(light.sphere, block));
}

#endif
