#version 460
// The scale of each tile's cells, and which of them hold points. One workgroup per tile.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/culling_2_5d/depth_cells.glsl"
#include "lab/techniques/device/tile_grid.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Positions { vec4 d[]; } positions;
layout(std430, set = 0, binding = 1) readonly buffer Depths { vec2 d[]; } depths;
layout(std430, set = 0, binding = 2) writeonly buffer Scales { vec2 d[]; } scales;
layout(std430, set = 0, binding = 3) writeonly buffer Occupied { uvec2 d[]; } occupied;
layout(push_constant) uniform Push {
    uint width, height;
    TileGrid grid;
    uint cell_count;
};

shared vec2 scale;
shared uint low_bits, high_bits;

void main() {
    uint tile = tile_index(grid, gl_WorkGroupID.xy);
    if (gl_LocalInvocationIndex == 0u) {
        vec2 ends = depths.d[tile];
        scale = vec2(ends.x, ends.y > ends.x ? float(cell_count) / (ends.y - ends.x) : 0.0);
        low_bits = high_bits = 0u;
    }
    barrier();
    uvec2 first = first_pixel_of(grid, gl_WorkGroupID.xy);
    uvec2 size = last_pixel_of(grid, gl_WorkGroupID.xy, uvec2(width, height)) - first + 1u;
    for (uint i = gl_LocalInvocationIndex; i < size.x * size.y; i += 64u) {
        uvec2 pixel = first + uvec2(i % size.x, i / size.x);
        float depth = positions.d[pixel.y * width + pixel.x].w;
        if (!(depth > 0.0)) continue;
        uvec2 bit = cell_bit(depth_cell(depth, scale, cell_count));
        if (bit.x != 0u) atomicOr(low_bits, bit.x);
        if (bit.y != 0u) atomicOr(high_bits, bit.y);
    }
    barrier();
    if (gl_LocalInvocationIndex != 0u) return;
    scales.d[tile] = scale;
    occupied.d[tile] = uvec2(low_bits, high_bits);
}
