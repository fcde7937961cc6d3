#version 450
// Runs for as many steps as it is told.
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer Result { uint d[]; } result;
layout(push_constant) uniform Push { uint steps; };

void main() {
    uint state = 1u;
    for (uint i = 0u; i < steps; ++i) state = state * 1664525u + (state >> 7u) + 1u;
    result.d[0] = state;
}
