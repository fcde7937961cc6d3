#version 460
// A light at a texel: a link with the depths that the light's sphere has there, put in front of the texel's list. A link
// beyond the pool is counted and not written.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/light_linked_list/light_links_build.glsl"
#define POOL_BINDING 4
#define POOL_ACCESS writeonly
#include "lab/techniques/light_linked_list/light_links.glsl"

layout(location = 0) flat in uint rank;
layout(constant_id = 0) const uint kDepthTest = 1u;
layout(constant_id = 1) const uint kLossy = 0u; // choices in the order of light_linked_list.cpp
const uint kByCentre = 1u, kByCoverage = 2u, kByRounding = 3u;

layout(std430, set = 0, binding = 1) readonly buffer Farthest { float d[]; } farthest;
layout(std430, set = 0, binding = 2) buffer Counter { uint links; } counter;
layout(std430, set = 0, binding = 3) buffer Heads { uint d[]; } heads;

// From here on links are no longer counted, far from where their number would begin again at 0.
const uint kMostLinks = 0x80000000u;

// Known to be wrong: of the ray through the texel's centre alone. Empty where it misses the sphere.
DepthSpan ray_depths(vec4 sphere, uvec2 texel) {
    vec2 centre = (vec2(texel) + 0.5) * vec2(grid.span / grid.tiles);
    vec3 ray = vec3((centre - 0.5 * vec2(view.size)) / vec2(view.right.w, view.down.w), 1.0);
    float a = dot(ray, ray), b = dot(ray, sphere.xyz);
    float d = b * b - a * (dot(sphere.xyz, sphere.xyz) - sphere.w * sphere.w);
    DepthSpan span = DepthSpan(kFarthest, -kFarthest);
    if (d >= 0.0) span = DepthSpan((b - sqrt(d)) / a, (b + sqrt(d)) / a);
    return span;
}

DepthSpan depths_at(vec4 sphere, uvec2 texel) {
    if (kLossy == kByCentre) return ray_depths(sphere, texel);
    DepthSpan span =
        rectangle_depths(view, first_pixel_of(grid, texel), last_pixel_of(grid, texel, view.size), sphere);
    if (kLossy == kByCoverage) {
        DepthSpan ray = ray_depths(sphere, texel);
        if (ray.low > ray.high) span = ray;
    }
    return span;
}

uint halves_of(DepthSpan span) {
    if (kLossy == kByRounding) return half_nearest(span.low) << 16u | half_nearest(span.high);
    return half_below(span.low) << 16u | half_above(span.high);
}

void write_word(uint page, uint at, uint word) {
    if (page == 0u) pool0.d[at] = word;
    else if (page == 1u) pool1.d[at] = word;
    else if (page == 2u) pool2.d[at] = word;
    else if (page == 3u) pool3.d[at] = word;
    else if (page == 4u) pool4.d[at] = word;
    else if (page == 5u) pool5.d[at] = word;
    else if (page == 6u) pool6.d[at] = word;
    else pool7.d[at] = word;
}

void write_link(uint link, DepthSpan span, uint next) {
    uint page = link >> kPageBits, at = first_word(link, link_words);
    if (link_words == 2u) {
        write_word(page, at, halves_of(span));
        write_word(page, at + 1u, rank << 24u | (next & kNoShortLink));
        return;
    }
    if (link_words == 3u) {
        write_word(page, at, halves_of(span));
    } else {
        write_word(page, at, floatBitsToUint(span.low));
        write_word(page, at + 1u, floatBitsToUint(span.high));
    }
    write_word(page, at + link_words - 2u, lights.d[rank].index);
    write_word(page, at + link_words - 1u, next);
}

void main() {
    uvec2 texel = uvec2(gl_FragCoord.xy);
    uint list = tile_index(grid, texel);
    DepthSpan span = depths_at(lights.d[rank].sphere, texel);
    if (!(span.low <= span.high) || span.high < 0.0) return;
    if (kDepthTest != 0u && span.low > farthest.d[list]) return;
    if (counter.links >= kMostLinks) return;
    uint link = atomicAdd(counter.links, 1u);
    if (link >= capacity) return;
    write_link(link, span, atomicExchange(heads.d[list], link));
}
