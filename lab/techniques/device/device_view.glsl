// A frame's camera, as push constants: device_view.h says what the members are.
#ifndef MANYLIGHTS_LAB_DEVICE_VIEW_GLSL
#define MANYLIGHTS_LAB_DEVICE_VIEW_GLSL

#include "lab/techniques/device/sphere_bounds.h"

struct DeviceView {
    vec4 right, down, forward;
    uvec2 size;
    vec2 reach;
};

// A sphere in the camera's axes: offsets to the right and down, depth, culling radius. Of a light as the membership
// stream has it: relative to the camera, along the world's axes. What is so far or so large that squares might overflow
// counts as being everywhere.
vec4 in_view(DeviceView view, vec4 sphere) {
    if (!(length(sphere.xyz) + sphere.w < 1e17)) return vec4(0.0, 0.0, 0.0, 1e18);
    vec3 center = vec3(dot(view.right.xyz, sphere.xyz), dot(view.down.xyz, sphere.xyz), dot(view.forward.xyz, sphere.xyz));
    return vec4(center, culling_radius(sphere.w, length(sphere.xyz)));
}

PixelSpan columns_of(DeviceView view, vec4 sphere) {
    return pixel_span(sphere.x, sphere.z, sphere.w, view.right.w, float(view.size.x), view.reach.x);
}

PixelSpan rows_of(DeviceView view, vec4 sphere) {
    return pixel_span(sphere.y, sphere.z, sphere.w, view.down.w, float(view.size.y), view.reach.y);
}

// The depths of the sphere in the pyramid of a rectangle of pixels; first and last are inside. Empty: low above high.
DepthSpan rectangle_depths(DeviceView view, uvec2 first, uvec2 last, vec4 sphere) {
    vec2 size = vec2(view.size);
    DepthSpan across =
        wedge_depths(pixel_edge_slope(first.x, -1.0, view.right.w, size.x, view.reach.x),
                     pixel_edge_slope(last.x, 1.0, view.right.w, size.x, view.reach.x), sphere.x, sphere.z, sphere.w);
    DepthSpan down =
        wedge_depths(pixel_edge_slope(first.y, -1.0, view.down.w, size.y, view.reach.y),
                     pixel_edge_slope(last.y, 1.0, view.down.w, size.y, view.reach.y), sphere.y, sphere.z, sphere.w);
    return meet(across, down);
}

// Whether the sphere, which may meet each side of that pyramid, is beside one of its four edges and misses all of it.
bool misses_corner(DeviceView view, uvec2 first, uvec2 last, vec4 sphere) {
    vec2 size = vec2(view.size);
    bool misses = false;
    for (uint corner = 0u; corner < 4u; ++corner) {
        bvec2 is_last = bvec2((corner & 1u) != 0u, (corner & 2u) != 0u);
        uvec2 pixel = mix(first, last, is_last);
        vec2 outwards = mix(vec2(-1.0), vec2(1.0), is_last);
        SlopeBound across =
            SlopeBound(pixel_edge_slope(pixel.x, outwards.x, view.right.w, size.x, view.reach.x), -outwards.x);
        SlopeBound down =
            SlopeBound(pixel_edge_slope(pixel.y, outwards.y, view.down.w, size.y, view.reach.y), -outwards.y);
        misses = misses || misses_edge(across, down, sphere.x, sphere.y, sphere.z, sphere.w);
    }
    return misses;
}

#endif
