#version 460
// The numbers of the froxels whose bits are set. An invocation per word.
#extension GL_GOOGLE_include_directive : require
#define FROXEL_BINDING 2
#include "lab/techniques/device/froxel_grid.glsl"
#include "lab/techniques/device/spread.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Bits { uint d[]; } bits;
layout(std430, set = 0, binding = 1) readonly buffer Places { uint d[]; } places; // bits before each word
layout(std430, set = 0, binding = 3) writeonly buffer Cells { uint d[]; } cells;
layout(push_constant) uniform Push { uint word_count; };

void main() {
    uint word = spread_index(64u);
    if (word >= word_count) return;
    uint words_per_tile = (froxels.slice_count + 31u) / 32u;
    uint base = word / words_per_tile * froxels.slice_count + word % words_per_tile * 32u;
    uint place = places.d[word];
    for (uint left = bits.d[word]; left != 0u; left &= left - 1u) cells.d[place++] = base + uint(findLSB(left));
}
