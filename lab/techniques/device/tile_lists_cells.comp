#version 460
// Where each list begins and how long it is, side by side. About 64 of them per invocation, in strides.

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Counts { uint d[]; } counts;
layout(std430, set = 0, binding = 1) readonly buffer Places { uint d[]; } places;
layout(std430, set = 0, binding = 2) writeonly buffer Cells { uvec2 d[]; } cells;
layout(push_constant) uniform Push { uint list_count; };

void main() {
    uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    for (uint i = gl_GlobalInvocationID.x; i < list_count; i += stride) cells.d[i] = uvec2(places.d[i], counts.d[i]);
}
