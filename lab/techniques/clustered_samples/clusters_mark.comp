#version 460
// Which keys have samples: a bit each.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/samples.glsl"
#include "lab/techniques/clustered_samples/slots.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, set = 0, binding = 5) buffer Bits { uint d[]; } bits;

void main() {
    ViewSample found = sample_at(gl_GlobalInvocationID.xy);
    if (!found.is_shaded) return;
    uint slot = slot_of(key_of(gl_GlobalInvocationID.xy, found));
    atomicOr(bits.d[slot >> 5u], 1u << (slot & 31u));
}
