#version 450
// Counts what a loop of a length that the compiler cannot know does, with another one after it.
layout(local_size_x = 8) in;
layout(set = 0, binding = 0) buffer Result { uint d[]; } result;
layout(push_constant) uniform Push { uint iterations; };

void main() {
    uint state = gl_LocalInvocationIndex;
    for (uint i = 0u; i < iterations; ++i) state = state * 1664525u + 1013904223u;
    for (uint i = 0u; i < iterations; ++i) state = state * 22695477u + 1u;
    result.d[gl_LocalInvocationIndex] = state;
}
