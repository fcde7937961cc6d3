#version 460
// Which lights go to the lists of which tiles: those whose depths meet the depths of the tile's points.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/tile_lists.glsl"

// Choices in the order of tiled.cpp.
layout(constant_id = 0) const uint depth_choice = 0u;
layout(constant_id = 1) const uint test_choice = 0u;
const uint kMax = 1u, kNone = 2u;
const uint kNarrowed = 0u, kPlanes = 2u;

layout(std430, set = 0, binding = 3) readonly buffer Depths { vec2 d[]; } depths; // of tiles

// Those that the tile's points may have. Empty, low above high, where there is no point.
DepthSpan points_span(uint tile) {
    DepthSpan span;
    span.low = -kFarthest;
    span.high = kFarthest;
    if (depth_choice == kNone) return span;
    vec2 least_greatest = depths.d[tile];
    bool is_empty = least_greatest.x > least_greatest.y;
    if (depth_choice != kMax || is_empty) span.low = least_greatest.x;
    span.high = least_greatest.y;
    return span;
}

// Whether no side of the tile's pyramid has all of the sphere outside: where the depths within are empty, one has.
bool meets_sides(VisibleLight light, uvec2 tile) {
    vec4 sphere = light.sphere;
    uvec2 first = first_pixel_of(grid, tile), last = last_pixel_of(grid, tile, view.size);
    vec2 size = vec2(view.size);
    vec2 low = vec2(pixel_edge_slope(first.x, -1.0, view.right.w, size.x, view.reach.x),
                    pixel_edge_slope(first.y, -1.0, view.down.w, size.y, view.reach.y));
    vec2 high = vec2(pixel_edge_slope(last.x, 1.0, view.right.w, size.x, view.reach.x),
                     pixel_edge_slope(last.y, 1.0, view.down.w, size.y, view.reach.y));
    bool is_inside = true;
    for (uint axis = 0u; axis < 2u; ++axis) {
        DepthSpan before = half_space_depths(low[axis], 1.0, sphere[axis], sphere.z, sphere.w);
        DepthSpan behind = half_space_depths(high[axis], -1.0, sphere[axis], sphere.z, sphere.w);
        is_inside = is_inside && before.low <= before.high && behind.low <= behind.high;
    }
    return is_inside;
}

void visit(VisibleLight light, uvec2 tile) {
    uint list = tile_index(grid, tile);
    DepthSpan span = points_span(list);
    if (span.low > span.high) return;
    if (test_choice == kPlanes && !meets_sides(light, tile)) return;
    span = meet(span, test_choice == kNarrowed ? depths_in_tile(light, tile) : sphere_depths(light.sphere));
    if (span.low > span.high) return;
    add_light(list, light.index);
}
