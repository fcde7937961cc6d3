#version 460
// One surface and one light per invocation.
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lab/renderer/shading.glsl"

layout(local_size_x = 64) in;

struct Case {
    vec3 position, normal;
    MaterialRecord material;
    vec3 center;
    float range;
    vec3 intensity;
};

layout(scalar, set = 0, binding = 0) readonly buffer Cases { Case d[]; }
cases;
layout(std430, set = 0, binding = 1) writeonly buffer Results { vec4 d[]; }
results;
layout(push_constant) uniform Push { uint count; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    Case c = cases.d[i];
    Surface surface = make_surface(c.position, c.normal, c.material);
    results.d[2u * i] = vec4(light_radiance(surface, c.center, c.range, c.intensity), 0.0);
    results.d[2u * i + 1u] = vec4(unlit_radiance(surface), 0.0);
}
