// Whether a light reaches all froxels of a node. The includer brings the view and froxel_grid.glsl; corners come from a
// table or are computed at each use.
#ifndef MANYLIGHTS_LAB_OCTREE_CORE_GLSL
#define MANYLIGHTS_LAB_OCTREE_CORE_GLSL

#include "lab/techniques/octree/octree_corner.glsl"

layout(constant_id = 1) const uint kHasCornerTable = 1u;
layout(std430, set = 0, binding = 6) readonly buffer Corners { vec4 d[]; } corners;

vec3 corner_at(uvec3 vertex) {
    return kHasCornerTable != 0u ? corners.d[corner_index(vertex)].xyz : computed_corner(vertex);
}

// Vertices along an axis: the inner ones of the outermost froxels, which are one where there are two froxels. A single
// froxel has no inner vertex, and either of its two will do: touching it is enough.
uvec3 nearer_vertex(vec4 sphere, uvec3 froxel) {
    vec3 low = corner_at(froxel), high = corner_at(froxel + uvec3(1u, 1u, 0u));
    vec2 middle = 0.5 * (low.xy + high.xy);
    uvec2 beyond = uvec2(greaterThan(sphere.xy * low.z, middle * sphere.z));
    float end = froxels.edges[froxel.z + 1u];
    // The plane behind the last slice is nowhere.
    uint behind = froxel.z + 1u < froxels.slice_count && sphere.z > 0.5 * (low.z + end) ? 1u : 0u;
    return froxel + uvec3(beyond, behind);
}

// Whether the sphere has all innermost corners of the outermost froxels (Lamecki, Kaczmarek, Porter-Sobieraj, section
// III). Then it has the hull of these corners, and every froxel touches that hull: the light belongs into the lists of
// all of them. A light is never lost by it, for a node's list is read by all points of its froxels. The radius is a
// little smaller, so that rounding does not store a light above froxels that it would not be stored in.
bool holds_core(vec4 sphere, uvec3 first, uvec3 last) {
    uvec3 low = first + 1u, high = last;
    bvec3 is_single = equal(first, last);
    if (any(is_single)) {
        uvec3 nearer = nearer_vertex(sphere, first);
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

#endif
