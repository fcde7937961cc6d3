#version 450
// How often each digit occurs in each block of 1024 keys: counts[digit * blocks + block].
layout(local_size_x = 256) in;

layout(std430, set = 0, binding = 0) readonly buffer Keys { uint d[]; } keys;
layout(std430, set = 0, binding = 1) writeonly buffer Counts { uint d[]; } counts;
layout(push_constant) uniform Push { uint count, shift; };

const uint kDigits = 16u;
const uint kPairsPerBlock = 1024u;

shared uint sums[kDigits];

void main() {
    uint lane = gl_LocalInvocationIndex;
    if (lane < kDigits) sums[lane] = 0u;
    barrier();
    uint first = gl_WorkGroupID.x * kPairsPerBlock;
    for (uint i = first + lane; i < min(first + kPairsPerBlock, count); i += 256u)
        atomicAdd(sums[(keys.d[i] >> shift) % kDigits], 1u);
    barrier();
    if (lane < kDigits) counts.d[lane * gl_NumWorkGroups.x + gl_WorkGroupID.x] = sums[lane];
}
