#version 460
// Which lights are in view: 1 for each of these, else 0.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/device_view.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Spheres { vec4 d[]; } spheres;
layout(std430, set = 0, binding = 1) writeonly buffer Marks { uint d[]; } marks;
layout(push_constant) uniform Push {
    DeviceView view;
    uint light_count;
};

bool is_empty(PixelSpan span) { return span.first > span.last; }

void main() {
    uint light = gl_GlobalInvocationID.x;
    if (light >= light_count) return;
    bool visible = false;
    if (spheres.d[light].w > 0.0) {
        vec4 sphere = in_view(view, spheres.d[light]);
        visible = sphere.z + sphere.w >= view.forward.w && !is_empty(columns_of(view, sphere)) &&
                  !is_empty(rows_of(view, sphere));
    }
    marks.d[light] = visible ? 1u : 0u;
}
