#version 460
// Inserts froxels into an octree that other invocations insert froxels into (Crassin, Neyret, Sainz, Green, Eisemann,
// Interactive Indirect Illumination Using Voxel Cone Tracing, 2011). Who finds a node without children makes eight; who
// finds another one at it gives up and puts the froxel aside for the next dispatch. Nobody waits: lanes that share a
// program counter would do so for ever.
#extension GL_GOOGLE_include_directive : require
#define FROXEL_BINDING 1
#define OCTREE_BINDING 2
#define OCTREE_BUILD
#include "lab/techniques/device/spread.glsl"
#include "lab/techniques/octree/octree.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Cells { uint d[]; } cells;
layout(std430, set = 0, binding = 4) buffer Counts { uint node_count, later_count; } counts;
layout(std430, set = 0, binding = 5) writeonly buffer Later { uint d[]; } later; // froxels put aside
layout(push_constant) uniform Push { uint cell_count; };

const uint kBusy = 0xFFFFFFFFu;

// The first child; kBusy while somebody else makes it. Nodes are empty before they have a number, so whoever learns the
// number may go on to them.
uint first_child(uint node) {
    uint first = atomicCompSwap(octree_nodes.d[node], 0u, kBusy);
    if (first != 0u) return first;
    first = atomicAdd(counts.node_count, 8u);
    atomicExchange(octree_nodes.d[node], first);
    return first;
}

void main() {
    uint i = spread_index(64u);
    if (i >= cell_count) return;
    uvec3 at = froxel_at(cells.d[i]);
    uint node = 0u;
    for (uint level = root_level(); level > 0u; --level) {
        uint first = first_child(node);
        if (first == kBusy) {
            later.d[atomicAdd(counts.later_count, 1u)] = cells.d[i];
            return;
        }
        node = first + octant_of(at >> (level - 1u));
    }
    atomicExchange(octree_nodes.d[node], 1u);
}
