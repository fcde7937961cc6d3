#version 450
// The last invocations pass memory barriers that the others do not: in a loop, since the faulty drivers run the body of
// every `if` with the inactive lanes masked off. It must not count as the execution barrier that all of them pass next:
// each reads what the one 64 places further has written.
layout(local_size_x = 128) in;
layout(set = 0, binding = 0) buffer Result { uint d[]; } result;
layout(push_constant) uniform Push { uint first_divergent; };

shared uint values[128];

void main() {
    uint i = gl_LocalInvocationIndex;
    values[i] = 0u;
    barrier();
    uint rounds = i >= first_divergent ? 3u : 0u;
    for (uint round = 0u; round < rounds; ++round) memoryBarrierShared();
    values[i] = i + 1u;
    barrier();
    result.d[i] = values[(i + 64u) % 128u];
}
