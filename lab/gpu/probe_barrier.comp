#version 450
// The last invocations pass a memory barrier that the others do not. It must not count as the execution barrier that
// all of them pass next: each reads what the one 64 places further has written.
layout(local_size_x = 128) in;
layout(set = 0, binding = 0) buffer Result { uint d[]; } result;
layout(push_constant) uniform Push { uint first_divergent; };

shared uint values[128];

void main() {
    uint i = gl_LocalInvocationIndex;
    values[i] = 0u;
    barrier();
    if (i >= first_divergent) memoryBarrierShared();
    values[i] = i + 1u;
    barrier();
    result.d[i] = values[(i + 64u) % 128u];
}
