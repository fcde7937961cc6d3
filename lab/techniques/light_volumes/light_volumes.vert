#version 460
// The volume of a light: a mesh around its sphere, or the rectangle of its pixels; or the image as a whole.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/rectangle.glsl"
#include "lab/techniques/device/visible_light.glsl"
#include "lab/techniques/light_volumes/volumes.glsl"

layout(constant_id = 1) const uint kFaces = 0u; // of the mesh, whose depths are compared
const uint kBackFaces = 0u;

layout(std430, set = 0, binding = 6) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 7) readonly buffer Order { uint d[]; } order;
layout(std430, set = 0, binding = 8) readonly buffer Mesh { vec4 d[]; } mesh;
layout(location = 0) flat out uint light_index;

const uint kAll = 0u, kAround = 2u; // of groups; 1: all others

// Corners are drawn at multiples of 1/256 of a pixel or finer: 1/16 of a pixel is far more than that moves an edge. Moved
// by a slope s, a ray at the sphere's depth moves by less than (|c| + r) s. 1e-4 is for the rounding of corners.
float volume_radius(vec4 sphere) {
    float far_end = length(sphere.xyz) + sphere.w;
    return sphere.w + far_end * (1e-4 + 1.0 / (16.0 * min(view.right.w, view.down.w)));
}

// Depth attachments hold near / depth, and the rasteriser interpolates it. Its error is that of the largest value of a
// triangle, some 2^-22 of it: with a mesh whose depths differ by a factor of 128 at most, less than 1e-3 of every
// fragment's own. Of others, which are around the camera or nearly so, depths are not compared.
const float kDepthSlack = 1e-3;
const float kMostDepths = 128.0;

bool is_around(float depth, float reach) {
    return depth - reach < max(view.forward.w, (depth + reach) / kMostDepths);
}

void place_mesh(vec4 sphere) {
    float radius = volume_radius(sphere);
    bool around = is_around(sphere.z, radius * mesh_reach);
    if (group != kAll && around != (group == kAround)) {
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0); // outside, all corners alike
        return;
    }
    vec3 corner = sphere.xyz + radius * mesh.d[gl_VertexIndex].xyz;
    float near = view.forward.w * (kFaces == kBackFaces ? 1.0 - kDepthSlack : 1.0 + kDepthSlack);
    gl_Position = vec4(2.0 * corner.xy * vec2(view.right.w, view.down.w) / vec2(view.size), around ? 0.0 : near,
                       corner.z);
}

void main() {
    light_index = 0u;
    if (kShape == kImage) {
        gl_Position = rectangle_vertex(gl_VertexIndex, vec2(0.0), vec2(view.size), vec2(view.size));
        return;
    }
    VisibleLight light = lights.d[order.d[gl_InstanceIndex]];
    light_index = light.index;
    if (kShape == kRectangle)
        gl_Position = rectangle_vertex(gl_VertexIndex, vec2(first_pixel(light)), vec2(last_pixel(light) + 1u),
                                       vec2(view.size));
    else
        place_mesh(light.sphere);
}
