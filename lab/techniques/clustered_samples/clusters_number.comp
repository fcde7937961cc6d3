#version 460
// The number of each sample's cluster, which is how many keys with samples are before its own, and the cluster's key. All
// samples of a cluster write the same key.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/samples.glsl"
#include "lab/techniques/clustered_samples/slots.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, set = 0, binding = 5) readonly buffer Bits { uint d[]; } bits;
layout(std430, set = 0, binding = 6) readonly buffer Places { uint d[]; } places;
layout(std430, set = 0, binding = 7) writeonly buffer Ids { uint d[]; } ids;
layout(std430, set = 0, binding = 8) buffer Keys { uint d[]; } keys;

void main() {
    ViewSample found = sample_at(gl_GlobalInvocationID.xy);
    if (!found.is_shaded) return;
    uint key = key_of(gl_GlobalInvocationID.xy, found);
    uint slot = slot_of(key);
    uint id = places.d[slot >> 5u] + bits_below(bits.d[slot >> 5u], slot);
    ids.d[found.index] = id;
    atomicExchange(keys.d[id], key);
}
