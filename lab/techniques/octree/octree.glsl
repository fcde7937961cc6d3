// An octree over froxels: a node of level l stands for 2^l froxels along each axis, level 0 for one. What lies outside
// of the grid has no node. octree_levels.h makes the first buffer. The includer brings FROXEL_BINDING, and
// OCTREE_BINDING, the first of the octree's two.
#ifndef MANYLIGHTS_LAB_OCTREE_GLSL
#define MANYLIGHTS_LAB_OCTREE_GLSL

#include "lab/techniques/device/froxel_grid.glsl"

const uint kMostLevels = 14u;
const uint kNoNode = 0xFFFFFFFFu;

layout(std430, set = 0, binding = OCTREE_BINDING) readonly buffer Octree {
    uint level_count; // the root's level is the last
    uint is_sparse;
    uint unused_a, unused_b;
    uvec4 levels[kMostLevels]; // nodes along each axis; w: of dense forms, the number of the first node
}
octree;
// Dense: a bit per node, whether a froxel of it has a sample. Sparse: a word per node, the number of the first of its
// eight children; 0 where no froxel of it has a sample; of leaves with a sample it is not 0.
layout(std430, set = 0, binding = OCTREE_BINDING + 1)
#if !defined(OCTREE_BUILD)
    readonly
#endif
    buffer OctreeNodes {
    uint d[];
}
octree_nodes;

uint root_level() { return octree.level_count - 1u; }

uint dense_node(uint level, uvec3 at) {
    uvec4 along = octree.levels[level];
    return along.w + (at.y * along.x + at.x) * along.z + at.z;
}

uint root_node() { return octree.is_sparse != 0u ? 0u : dense_node(root_level(), uvec3(0u)); }

uint octant_of(uvec3 at) { return (at.x & 1u) | (at.y & 1u) << 1u | (at.z & 1u) << 2u; }

// The child at these coordinates of its level; one that is there.
uint child_of(uint parent, uint level, uvec3 at) {
    return octree.is_sparse != 0u ? octree_nodes.d[parent] + octant_of(at) : dense_node(level, at);
}

bool has_samples(uint node) {
    if (octree.is_sparse != 0u) return octree_nodes.d[node] != 0u;
    return (octree_nodes.d[node / 32u] >> node % 32u & 1u) != 0u;
}

// Of a froxel's number.
uvec3 froxel_at(uint froxel) {
    uint tile = froxel / froxels.slice_count;
    return uvec3(tile % froxels.tiles.tiles.x, tile / froxels.tiles.tiles.x, froxel % froxels.slice_count);
}

#endif
