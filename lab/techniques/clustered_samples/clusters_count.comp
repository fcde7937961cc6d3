#version 460
// How many bits each word has.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/spread.glsl"

layout(local_size_x = 256) in;
layout(std430, set = 0, binding = 0) readonly buffer Bits { uint d[]; } bits;
layout(std430, set = 0, binding = 1) writeonly buffer Counts { uint d[]; } counts;
layout(push_constant) uniform Push { uint word_count; };

void main() {
    uint word = spread_index(256u);
    if (word < word_count) counts.d[word] = bitCount(bits.d[word]);
}
