#version 460
// The farthest depth of each texel's pixels, and of no others; sky is at infinity. An invocation per texel.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/tile_grid.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kCentreOnly = 0u; // known to be wrong: the depth of one pixel stands for all
layout(std430, set = 0, binding = 0) readonly buffer Positions { vec4 d[]; } positions;
layout(std430, set = 0, binding = 1) writeonly buffer Farthest { float d[]; } farthest;
layout(push_constant) uniform Push {
    uint width, height;
    TileGrid grid;
};

float depth_of(uvec2 pixel) {
    float depth = positions.d[pixel.y * width + pixel.x].w;
    return depth > 0.0 ? depth : uintBitsToFloat(0x7F800000u);
}

void main() {
    uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, grid.tiles))) return;
    uvec2 first = first_pixel_of(grid, texel), last = last_pixel_of(grid, texel, uvec2(width, height));
    if (kCentreOnly != 0u) first = last = min(first + grid.span / grid.tiles / 2u, last);
    float depth = 0.0;
    for (uint y = first.y; y <= last.y; ++y)
        for (uint x = first.x; x <= last.x; ++x) depth = max(depth, depth_of(uvec2(x, y)));
    farthest.d[tile_index(grid, texel)] = depth;
}
