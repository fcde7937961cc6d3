#version 460
// The box of the lights' centres: the greatest of each coordinate and of its negative, as ordered words.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/hierarchy.glsl"
#include "lab/techniques/device/spread.glsl"
#include "lab/techniques/device/visible_light.glsl"

layout(local_size_x = 256) in;
layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 1) buffer Extent { uint d[]; } extent;
layout(push_constant) uniform Push { uint light_count; };

shared uint greatest[6];

void main() {
    uint lane = gl_LocalInvocationIndex, light = spread_index(256u);
    if (lane < 6u) greatest[lane] = 0u;
    barrier();
    if (light < light_count) {
        vec3 center = lights.d[light].sphere.xyz;
        for (uint axis = 0u; axis < 3u; ++axis) {
            atomicMax(greatest[axis], ordered_word(-center[axis]));
            atomicMax(greatest[3u + axis], ordered_word(center[axis]));
        }
    }
    barrier();
    if (lane < 6u) atomicMax(extent.d[lane], greatest[lane]);
}
