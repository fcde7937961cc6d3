#version 460
// What the shaders read of a reference: the index of its light, or all of the light (light_records.h).
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device_build/ranked_lights.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kHasRecords = 0u;
layout(std430, set = 0, binding = 5) readonly buffer Spheres { vec4 d[]; } spheres;
layout(std430, set = 0, binding = 6) readonly buffer Colors { vec4 d[]; } colors;
layout(std430, set = 0, binding = 7) writeonly buffer References { uint d[]; } references;
layout(push_constant) uniform Push { uint reference_count; };

void write_record(uint reference, uint light) {
    vec4 sphere = spheres.d[light], color = colors.d[light];
    for (uint i = 0u; i < 4u; ++i) references.d[8u * reference + i] = floatBitsToUint(sphere[i]);
    for (uint i = 0u; i < 3u; ++i) references.d[8u * reference + 4u + i] = floatBitsToUint(color[i]);
    references.d[8u * reference + 7u] = light;
}

void main() {
    uint reference = spread_index(64u);
    if (reference >= reference_count) return;
    uint light = lights.d[order.d[ranks.d[reference]]].index;
    if (kHasRecords != 0u)
        write_record(reference, light);
    else
        references.d[reference] = light;
}
