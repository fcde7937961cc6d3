#version 460
// What the lights in view are sorted by: a depth as a whole number that ascends with it.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/visible_light.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kByNearEnd = 0u; // instead of the centre
layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 1) writeonly buffer Keys { uint d[]; } keys;
layout(std430, set = 0, binding = 2) writeonly buffer Order { uint d[]; } order;
layout(push_constant) uniform Push { uint light_count; };

void main() {
    uint light = gl_GlobalInvocationID.x;
    if (light >= light_count) return;
    vec4 sphere = lights.d[light].sphere;
    uint bits = floatBitsToUint(kByNearEnd != 0u ? sphere.z - sphere.w : sphere.z);
    keys.d[light] = bits ^ (bits >> 31u != 0u ? 0xFFFFFFFFu : 0x80000000u);
    order.d[light] = light;
}
