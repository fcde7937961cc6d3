#version 460
// Which pages of keys have samples: a bit each.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/samples.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, set = 0, binding = 3) buffer Pages { uint d[]; } pages;

const uint kPageBits = 10u; // as in slots.glsl

void main() {
    ViewSample found = sample_at(gl_GlobalInvocationID.xy);
    if (!found.is_shaded) return;
    uint page = key_of(gl_GlobalInvocationID.xy, found) >> kPageBits;
    atomicOr(pages.d[page >> 5u], 1u << (page & 31u));
}
