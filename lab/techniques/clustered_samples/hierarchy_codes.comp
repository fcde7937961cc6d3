#version 460
// The Morton codes of the lights' centres in their box: 10 bits of each coordinate. They decide where a light is in the
// hierarchy, and never what is found there.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/hierarchy.glsl"
#include "lab/techniques/device/spread.glsl"
#include "lab/techniques/device/visible_light.glsl"

layout(local_size_x = 256) in;
layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 1) readonly buffer Extent { uint d[]; } extent;
layout(std430, set = 0, binding = 2) writeonly buffer Codes { uint d[]; } codes;
layout(std430, set = 0, binding = 3) writeonly buffer Places { uint d[]; } places; // among the lights in view
layout(push_constant) uniform Push { uint light_count; };

uint spread_bits(uint value) {
    value = (value | value << 16u) & 0x030000FFu;
    value = (value | value << 8u) & 0x0300F00Fu;
    value = (value | value << 4u) & 0x030C30C3u;
    return (value | value << 2u) & 0x09249249u;
}

uint quantized(float center, uint axis) {
    float low = -value_of_ordered(extent.d[axis]);
    float size = value_of_ordered(extent.d[3u + axis]) - low;
    return size > 0.0 ? min(uint(clamp((center - low) / size, 0.0, 1.0) * 1024.0), 1023u) : 0u;
}

void main() {
    uint light = spread_index(256u);
    if (light >= light_count) return;
    vec3 center = lights.d[light].sphere.xyz;
    uint code = 0u;
    for (uint axis = 0u; axis < 3u; ++axis) code |= spread_bits(quantized(center[axis], axis)) << axis;
    codes.d[light] = code;
    places.d[light] = light;
}
