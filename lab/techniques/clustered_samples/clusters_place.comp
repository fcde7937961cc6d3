#version 460
// The keys of all tiles one behind the other, and ids among all of them. One workgroup per tile. places: keys of the
// tiles before, and behind the last tile the number of all.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/samples.glsl"

layout(local_size_x = 256) in;
layout(std430, set = 0, binding = 3) buffer Ids { uint d[]; } ids;
layout(std430, set = 0, binding = 4) readonly buffer TileKeys { uint d[]; } tile_keys;
layout(std430, set = 0, binding = 5) readonly buffer Places { uint d[]; } places;
layout(std430, set = 0, binding = 6) writeonly buffer Keys { uint d[]; } keys;

void main() {
    uint tile = gl_WorkGroupID.y * tiles_x + gl_WorkGroupID.x, count = tile_size * tile_size;
    uint first = places.d[tile], key_count = places.d[tile + 1u] - first;
    for (uint i = gl_LocalInvocationIndex; i < count; i += 256u) {
        if (i < key_count) keys.d[first + i] = tile * slice_count * patch_count + tile_keys.d[tile * count + i];
        ViewSample found = sample_at(gl_WorkGroupID.xy * tile_size + uvec2(i % tile_size, i / tile_size));
        if (found.is_shaded) ids.d[found.index] += first;
    }
}
