// The pass of tile_pass.h. The includer brings, before this text, TILE_PASS_WORD, a name for the last push constant; and
// behind it
//
//     void visit(VisibleLight light, uvec2 tile)
//
// which is called once for each light and each tile under its pixels.
//
// An invocation goes over the tiles of a light of its own, unless these are many: then the workgroup goes over them
// together, so that one huge light does not keep one invocation busy for long.
#ifndef MANYLIGHTS_LAB_TILE_PASS_GLSL
#define MANYLIGHTS_LAB_TILE_PASS_GLSL

#include "lab/techniques/device/device_view.glsl"
#include "lab/techniques/device/tile_grid.glsl"
#include "lab/techniques/device/visible_light.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(push_constant) uniform Push {
    DeviceView view;
    TileGrid grid;
    uint light_count;
    uint TILE_PASS_WORD;
};

const uint kGroupSize = 64u;
const uint kMany = 64u; // tiles

void visit(VisibleLight light, uvec2 tile);

// The tiles under the light's pixels, row by row.
struct LightTiles {
    uvec2 first;
    uint columns, count;
};

LightTiles tiles_of(VisibleLight light) {
    LightTiles tiles;
    tiles.first = tile_of(grid, first_pixel(light));
    uvec2 size = tile_of(grid, last_pixel(light)) - tiles.first + 1u;
    tiles.columns = size.x;
    tiles.count = size.x * size.y;
    return tiles;
}

void visit_each(VisibleLight light, LightTiles tiles, uint start, uint stride) {
    for (uint i = start; i < tiles.count; i += stride)
        visit(light, tiles.first + uvec2(i % tiles.columns, i / tiles.columns));
}

void visit_many(uint first_light) {
    for (uint i = first_light; i < min(first_light + kGroupSize, light_count); ++i) {
        LightTiles tiles = tiles_of(lights.d[i]);
        if (tiles.count > kMany) visit_each(lights.d[i], tiles, gl_LocalInvocationIndex, kGroupSize);
    }
}

// The depths of the sphere itself. They need no slack beside the culling radius, which has more to spare than the
// rounding of the two sums: 4e-7 of range and distance, against 2^-24 of either.
DepthSpan sphere_depths(vec4 sphere) {
    DepthSpan span;
    span.low = sphere.z - sphere.w;
    span.high = sphere.z + sphere.w;
    return span;
}

// The depths of the sphere within the tile's pyramid.
DepthSpan depths_in_tile(VisibleLight light, uvec2 tile) {
    return rectangle_depths(view, first_pixel_of(grid, tile), last_pixel_of(grid, tile, view.size), light.sphere);
}

void main() {
    visit_many(gl_WorkGroupID.x * kGroupSize);
    if (gl_GlobalInvocationID.x >= light_count) return;
    VisibleLight light = lights.d[gl_GlobalInvocationID.x];
    LightTiles tiles = tiles_of(light);
    if (tiles.count <= kMany) visit_each(light, tiles, 0u, 1u);
}

#endif
