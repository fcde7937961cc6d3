#version 460
// The keys that octree_heads.comp marked, one behind the other. places: how many of them are before each key, and behind
// the last one how many there are.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/spread.glsl"

layout(local_size_x = 256) in;
layout(std430, set = 0, binding = 0) readonly buffer Keys { uint d[]; } keys;
layout(std430, set = 0, binding = 1) readonly buffer Places { uint d[]; } places;
layout(std430, set = 0, binding = 2) writeonly buffer Kept { uint d[]; } kept;
layout(push_constant) uniform Push { uint key_count; };

void main() {
    uint i = spread_index(256u);
    if (i < key_count && places.d[i] != places.d[i + 1u]) kept.d[places.d[i]] = keys.d[i];
}
