#version 460
// The least and the greatest depth of each tile's points. One workgroup per tile.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/tile_grid.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Positions { vec4 d[]; } positions;
layout(std430, set = 0, binding = 1) writeonly buffer Depths { vec2 d[]; } depths;
layout(push_constant) uniform Push {
    uint width, height;
    TileGrid grid;
};

// Depths are above 0, and the bits of such floats are ordered as they are.
const uint kInfinity = 0x7F800000u;
shared uint least, greatest;

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        least = kInfinity;
        greatest = 0u;
    }
    barrier();
    uvec2 first = first_pixel_of(grid, gl_WorkGroupID.xy);
    uvec2 size = last_pixel_of(grid, gl_WorkGroupID.xy, uvec2(width, height)) - first + 1u;
    for (uint i = gl_LocalInvocationIndex; i < size.x * size.y; i += 64u) {
        uvec2 pixel = first + uvec2(i % size.x, i / size.x);
        float depth = positions.d[pixel.y * width + pixel.x].w;
        if (!(depth > 0.0)) continue;
        atomicMin(least, floatBitsToUint(depth));
        atomicMax(greatest, floatBitsToUint(depth));
    }
    barrier();
    if (gl_LocalInvocationIndex != 0u) return;
    depths.d[tile_index(grid, gl_WorkGroupID.xy)] = vec2(uintBitsToFloat(least), uintBitsToFloat(greatest));
}
