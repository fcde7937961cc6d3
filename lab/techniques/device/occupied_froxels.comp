#version 460
// Which froxels hold points: a bit each.
#extension GL_GOOGLE_include_directive : require
#define FROXEL_BINDING 1
#include "lab/techniques/device/froxel_grid.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, set = 0, binding = 0) readonly buffer Positions { vec4 d[]; } positions;
layout(std430, set = 0, binding = 2) buffer Occupied { uint d[]; } occupied;
layout(push_constant) uniform Push { uvec2 size; };

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, size))) return;
    float depth = positions.d[pixel.y * size.x + pixel.x].w;
    if (!(depth > 0.0)) return;
    uint froxel = froxel_of(pixel, depth);
    atomicOr(occupied.d[froxel / 32u], 1u << (froxel & 31u));
}
