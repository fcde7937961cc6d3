#version 460
// The number of each pixel's froxel; of sky, the one behind all froxels.
#extension GL_GOOGLE_include_directive : require
#define FROXEL_BINDING 1
#include "lab/techniques/device/froxel_grid.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, set = 0, binding = 0) readonly buffer Positions { vec4 d[]; } positions;
layout(std430, set = 0, binding = 2) writeonly buffer Keys { uint d[]; } keys;
layout(push_constant) uniform Push {
    uvec2 image;
    uint sky;
};

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, image))) return;
    uint index = pixel.y * image.x + pixel.x;
    float depth = positions.d[index].w;
    keys.d[index] = depth > 0.0 ? froxel_of(pixel, depth) : sky;
}
