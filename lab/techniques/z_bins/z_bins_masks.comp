#version 460
// The masks of tiles: a bit per rank, set where the light's sphere may reach into the tile's pyramid. A workgroup makes
// the words of 1,024 ranks for a block of 8 x 8 tiles: it first finds the ranks whose rectangles reach the block, so
// that its tiles look at no others. Every word is written, by one thread.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/device_view.glsl"
#include "lab/techniques/device/visible_light.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kHasSummary = 0u;
layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 1) readonly buffer Order { uint d[]; } order;
layout(std430, set = 0, binding = 2) writeonly buffer Masks { uint d[]; } masks;
layout(std430, set = 0, binding = 3) writeonly buffer Summaries { uint d[]; } summaries;
layout(std430, set = 0, binding = 4) buffer BitCounts { uint d[]; } bit_counts; // per 1,024 ranks, over all tiles
layout(push_constant) uniform Push {
    DeviceView view;
    uvec2 tiles;
    uint tile_size;
    uint light_count;
};

const uint kBlockEdge = 8u, kWords = 32u;
shared uint candidates[kWords];

bool reaches(VisibleLight light, uvec2 first, uvec2 last) {
    return all(lessThanEqual(first_pixel(light), last)) && all(greaterThanEqual(last_pixel(light), first));
}

void find_candidates(uint first_rank) {
    uvec2 first = gl_WorkGroupID.xy * kBlockEdge * tile_size, last = first + kBlockEdge * tile_size - 1u;
    uint end = min(first_rank + 32u * kWords, light_count);
    for (uint rank = first_rank + gl_LocalInvocationIndex; rank < end; rank += 64u) {
        uint i = rank - first_rank;
        if (reaches(lights.d[order.d[rank]], first, last)) atomicOr(candidates[i / 32u], 1u << i % 32u);
    }
}

uint word_of(uint candidate_bits, uint first_rank, uvec2 first, uvec2 last) {
    uint word = 0u;
    for (uint bits = candidate_bits; bits != 0u; bits &= bits - 1u) {
        int bit = findLSB(bits);
        VisibleLight light = lights.d[order.d[first_rank + uint(bit)]];
        if (!reaches(light, first, last)) continue;
        DepthSpan depths = rectangle_depths(view, first, last, light.sphere);
        if (depths.low <= depths.high) word |= 1u << bit;
    }
    return word;
}

void main() {
    uint chunk = gl_WorkGroupID.z, first_rank = chunk * 32u * kWords;
    if (gl_LocalInvocationIndex < kWords) candidates[gl_LocalInvocationIndex] = 0u;
    barrier();
    find_candidates(first_rank);
    barrier();
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, tiles))) return;

    uint tile = gl_GlobalInvocationID.y * tiles.x + gl_GlobalInvocationID.x;
    uvec2 first = gl_GlobalInvocationID.xy * tile_size, last = min(first + tile_size, view.size) - 1u;
    uint word_count = (light_count + 31u) / 32u, count = min(word_count - chunk * kWords, kWords);
    uint filled = 0u, bit_count = 0u;
    for (uint i = 0u; i < count; i += 1u) {
        uint word = word_of(candidates[i], first_rank + 32u * i, first, last);
        masks.d[tile * word_count + chunk * kWords + i] = word;
        if (word != 0u) filled |= 1u << i;
        bit_count += uint(bitCount(word));
    }
    if (kHasSummary != 0u) summaries.d[tile * gl_NumWorkGroups.z + chunk] = filled;
    if (bit_count != 0u) atomicAdd(bit_counts.d[chunk], bit_count);
}
