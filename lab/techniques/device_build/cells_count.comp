#version 460
// How many cells each light goes to, by rank, and the end of the farthest light's depths.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/tile_grid.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    TileGrid grid;
    uint slice_count;
    uint light_count;
};
layout(std430, set = 0, binding = 2) readonly buffer SliceEdges { float d[]; } slice_edges;
#define SLICE_EDGE(i) slice_edges.d[i]
#include "lab/techniques/device_build/light_cells.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 1) readonly buffer Order { uint d[]; } order;
layout(std430, set = 0, binding = 3) writeonly buffer Counts { uint d[]; } counts;
layout(std430, set = 0, binding = 4) buffer Farthest { uint d[]; } farthest; // bits of a float above 0

void main() {
    uint rank = gl_GlobalInvocationID.x;
    if (rank >= light_count) return;
    VisibleLight light = lights.d[order.d[rank]];
    uvec3 size = cells_of(light).size;
    counts.d[rank] = size.x * size.y * size.z;
    atomicMax(farthest.d[0], floatBitsToUint(max(light.sphere.z + light.sphere.w, 0.0)));
}
