#version 460
// Which keys differ from the one before: 1 for each of these, else 0. Not those of sky. Behind the last one is a 0, so
// that its place is the number of all.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/spread.glsl"

layout(local_size_x = 256) in;
layout(std430, set = 0, binding = 0) readonly buffer Keys { uint d[]; } keys;
layout(std430, set = 0, binding = 1) writeonly buffer Heads { uint d[]; } heads;
layout(push_constant) uniform Push {
    uint key_count;
    uint sky;
};

void main() {
    uint i = spread_index(256u);
    if (i > key_count) return;
    bool is_head = i < key_count && keys.d[i] != sky && (i == 0u || keys.d[i - 1u] != keys.d[i]);
    heads.d[i] = is_head ? 1u : 0u;
}
