#version 460
// The lights in the order of the hierarchy: spheres in the camera's axes, and which lights they are.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/spread.glsl"
#include "lab/techniques/device/visible_light.glsl"

layout(local_size_x = 256) in;
layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 1) readonly buffer Places { uint d[]; } places;
layout(std430, set = 0, binding = 2) writeonly buffer Spheres { vec4 d[]; } spheres;
layout(std430, set = 0, binding = 3) writeonly buffer Indices { uint d[]; } indices;
layout(push_constant) uniform Push { uint light_count; };

void main() {
    uint leaf = spread_index(256u);
    if (leaf >= light_count) return;
    VisibleLight light = lights.d[places.d[leaf]];
    spheres.d[leaf] = light.sphere;
    indices.d[leaf] = light.index;
}
