#version 460
// Which froxels have samples: a bit each, 32 of the same tile to a word. One workgroup per tile.
#extension GL_GOOGLE_include_directive : require
#define FROXEL_BINDING 1
#include "lab/techniques/device/froxel_grid.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Positions { vec4 d[]; } positions;
layout(std430, set = 0, binding = 2) writeonly buffer Bits { uint d[]; } bits;
layout(push_constant) uniform Push { uvec2 image; };

const uint kMostWords = 128u; // of the 4,096 slices that a grid has at most
shared uint words[kMostWords];

void main() {
    uint word_count = (froxels.slice_count + 31u) / 32u, lane = gl_LocalInvocationIndex;
    for (uint i = lane; i < word_count; i += 64u) words[i] = 0u;
    barrier();
    uvec2 first = first_pixel_of(froxels.tiles, gl_WorkGroupID.xy);
    uvec2 size = last_pixel_of(froxels.tiles, gl_WorkGroupID.xy, image) + 1u - first;
    for (uint i = lane; i < size.x * size.y; i += 64u) {
        uvec2 pixel = first + uvec2(i % size.x, i / size.x);
        float depth = positions.d[pixel.y * image.x + pixel.x].w;
        if (!(depth > 0.0)) continue;
        uint slice = slice_of(depth);
        atomicOr(words[slice / 32u], 1u << slice % 32u);
    }
    barrier();
    uint tile = tile_index(froxels.tiles, gl_WorkGroupID.xy);
    for (uint i = lane; i < word_count; i += 64u) bits.d[tile * word_count + i] = words[i];
}
