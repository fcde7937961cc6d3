#version 460
// Which nodes have froxels with samples: the froxel's own, and those above it.
#extension GL_GOOGLE_include_directive : require
#define FROXEL_BINDING 1
#define OCTREE_BINDING 2
#define OCTREE_BUILD
#include "lab/techniques/device/spread.glsl"
#include "lab/techniques/octree/octree.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Cells { uint d[]; } cells;
layout(push_constant) uniform Push { uint cell_count; };

void main() {
    uint i = spread_index(64u);
    if (i >= cell_count) return;
    uvec3 at = froxel_at(cells.d[i]);
    for (uint level = 0u; level < octree.level_count; ++level) {
        uint node = dense_node(level, at >> level);
        atomicOr(octree_nodes.d[node / 32u], 1u << node % 32u);
    }
}
