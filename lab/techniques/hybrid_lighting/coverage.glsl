// The depths at which a light is said to cover a tile: what is right, and two ways to lose lights, which are here to be
// measured.
#ifndef MANYLIGHTS_LAB_COVERAGE_GLSL
#define MANYLIGHTS_LAB_COVERAGE_GLSL

#include "lab/techniques/device/tile_pass.glsl"

// As hybrid_lighting.cpp numbers them.
layout(constant_id = 0) const uint coverage = 0u;
const uint kCentreRay = 1u, kPlain = 2u;

// Pixels from the image's corner.
vec2 centre_of(uvec2 tile) { return (vec2(tile) + 0.5) * vec2(grid.span) / vec2(grid.tiles); }

DepthSpan no_depths() {
    DepthSpan span;
    span.low = kFarthest;
    span.high = -kFarthest;
    return span;
}

// Where the ray through the tile's centre is inside the sphere. With the ray's points at depth z being z d, and c the
// sphere's centre, |z d - c|^2 = r^2.
DepthSpan ray_depths(vec4 sphere, uvec2 tile) {
    vec3 d = vec3((centre_of(tile) - 0.5 * vec2(view.size)) / vec2(view.right.w, view.down.w), 1.0);
    float along = dot(d, sphere.xyz);
    float root = along * along - dot(d, d) * (dot(sphere.xyz, sphere.xyz) - sphere.w * sphere.w);
    DepthSpan span = no_depths();
    if (!(root >= 0.0)) return span;
    span.low = (along - sqrt(root)) / dot(d, d);
    span.high = (along + sqrt(root)) / dot(d, d);
    return span;
}

// As a rasteriser that is not conservative decides, which there has decided already.
#if defined(MANYLIGHTS_FRAGMENT)
bool holds_centre(VisibleLight light, uvec2 tile) { return true; }
#else
bool holds_centre(VisibleLight light, uvec2 tile) {
    vec2 centre = centre_of(tile);
    return all(greaterThanEqual(centre, vec2(first_pixel(light)))) &&
           all(lessThan(centre, vec2(last_pixel(light) + 1u)));
}
#endif

// Empty: low is above high.
DepthSpan covered_depths(VisibleLight light, uvec2 tile) {
    if (coverage == kCentreRay) return ray_depths(light.sphere, tile);
    if (coverage == kPlain && !holds_centre(light, tile)) return no_depths();
    if (misses_tile(light, tile)) return no_depths();
    return depths_in_tile(light, tile);
}

#endif
