#version 460
// The lights in view, one behind the other, in the order of their indices. places: how many of them are before each
// light, and behind the last one how many there are.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/device_view.glsl"
#include "lab/techniques/device/visible_light.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Spheres { vec4 d[]; } spheres;
layout(std430, set = 0, binding = 1) readonly buffer Places { uint d[]; } places;
layout(std430, set = 0, binding = 2) writeonly buffer Lights { VisibleLight d[]; } lights;
layout(push_constant) uniform Push {
    DeviceView view;
    uint light_count;
};

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= light_count || places.d[index] == places.d[index + 1u]) return;
    VisibleLight light;
    light.sphere = in_view(view, spheres.d[index]);
    light.index = index;
    PixelSpan columns = columns_of(view, light.sphere), rows = rows_of(view, light.sphere);
    light.columns = columns.first | columns.last << 16u;
    light.rows = rows.first | rows.last << 16u;
    light.unused = 0u;
    lights.d[places.d[index]] = light;
}
