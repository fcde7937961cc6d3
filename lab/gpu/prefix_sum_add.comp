#version 450
// Adds to every word of a block what the blocks before it come to.
layout(local_size_x = 256) in;

layout(std430, set = 0, binding = 0) buffer Target { uint d[]; } target;
layout(std430, set = 0, binding = 1) readonly buffer BlocksBefore { uint d[]; } blocks_before;
layout(push_constant) uniform Push { uint count; };

const uint kWordsPerBlock = 2048u;

void main() {
    uint first = gl_WorkGroupID.x * kWordsPerBlock;
    uint sum = blocks_before.d[gl_WorkGroupID.x];
    for (uint i = first + gl_LocalInvocationIndex; i < min(first + kWordsPerBlock, count); i += 256u)
        target.d[i] += sum;
}
