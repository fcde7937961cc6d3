#version 460
// Reversed depth with the far plane at infinity: z / w = near / depth.
#extension GL_GOOGLE_include_directive : require
#include "lab/renderer/point.glsl"

layout(location = 0) in vec3 position_ws;
layout(location = 1) in vec3 normal_ws;
layout(location = 2) in uint material;
layout(push_constant) uniform Push { CameraAxes camera; };

layout(location = 0) out vec3 point;
layout(location = 1) out vec3 normal;
layout(location = 2) flat out uint material_id;

void main() {
    point = position_ws - camera.position.xyz;
    normal = normal_ws;
    material_id = material;
    gl_Position = vec4(dot(point, camera.right.xyz) / camera.right.w, -dot(point, camera.up.xyz) / camera.up.w,
                       camera.position.w, dot(point, camera.forward.xyz));
}
