#version 460
// The depth of each reference's light as a key, and the reference's own number: what cells are sorted by on their own.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/spread.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Ranks { uint d[]; } ranks;
layout(std430, set = 0, binding = 1) readonly buffer LightKeys { uint d[]; } light_keys; // by rank
layout(std430, set = 0, binding = 2) writeonly buffer Keys { uint d[]; } keys;
layout(std430, set = 0, binding = 3) writeonly buffer Numbers { uint d[]; } numbers;
layout(push_constant) uniform Push { uint pair_count; };

void main() {
    uint pair = spread_index(64u);
    if (pair >= pair_count) return;
    keys.d[pair] = light_keys.d[ranks.d[pair]];
    numbers.d[pair] = pair;
}
