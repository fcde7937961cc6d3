#version 460
// The depth buffer's pixels become points.
#extension GL_GOOGLE_include_directive : require
#include "lab/renderer/point.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, set = 0, binding = 0) readonly buffer Depths { float d[]; } depths;
layout(std430, set = 0, binding = 1) writeonly buffer Positions { vec4 d[]; } positions;
layout(push_constant) uniform Push {
    CameraAxes camera;
    uvec2 size;
};

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= size.x || pixel.y >= size.y) return;
    uint index = pixel.y * size.x + pixel.x;
    positions.d[index] = point_of_pixel(camera, pixel, size, depths.d[index]);
}
