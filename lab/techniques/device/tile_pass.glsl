// The pass of tile_pass.h. The includer brings, before this text, TILE_PASS_WORD, a name for the last push constant; and
// behind it
//
//     void visit(VisibleLight light, uvec2 tile)
//
// which is called once for each light and each tile under its pixels.
//
// In a compute shader an invocation goes over the tiles of a light of its own, unless these are many: then the workgroup
// goes over them together, so that one huge light does not keep one invocation busy for long. With MANYLIGHTS_FRAGMENT the
// rasteriser finds the tiles: the target has a pixel per tile, and each light is drawn there as a rectangle, its
// billboard, whose corners a vertex shader (MANYLIGHTS_VERTEX, without `visit`) takes from billboard_vertex.
#ifndef MANYLIGHTS_LAB_TILE_PASS_GLSL
#define MANYLIGHTS_LAB_TILE_PASS_GLSL

#include "lab/techniques/device/device_view.glsl"
#if defined(MANYLIGHTS_VERTEX)
#include "lab/techniques/device/rectangle.glsl"
#endif
#include "lab/techniques/device/tile_grid.glsl"
#include "lab/techniques/device/visible_light.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(push_constant) uniform Push {
    DeviceView view;
    TileGrid grid;
    uint light_count;
    uint TILE_PASS_WORD;
};

// The tiles under the light's pixels.
struct LightTiles {
    uvec2 first, size;
};

LightTiles tiles_of(VisibleLight light) {
    LightTiles tiles;
    tiles.first = tile_of(grid, first_pixel(light));
    tiles.size = tile_of(grid, last_pixel(light)) - tiles.first + 1u;
    return tiles;
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

bool misses_tile(VisibleLight light, uvec2 tile) {
    return misses_corner(view, first_pixel_of(grid, tile), last_pixel_of(grid, tile, view.size), light.sphere);
}

#if defined(MANYLIGHTS_VERTEX)

// A vertex of the light's billboard, a pixel per tile. Snapped, it goes around the tiles under the light's pixels, so that
// each of them has its centre inside and is drawn, once, by every rasteriser, though none need be conservative.
vec4 billboard_vertex(VisibleLight light, int vertex, bool is_snapped) {
    LightTiles tiles = tiles_of(light);
    vec2 first = vec2(tiles.first), end = vec2(tiles.first + tiles.size);
    if (!is_snapped) {
        first = vec2(first_pixel(light)) * vec2(grid.tiles) / vec2(grid.span);
        end = vec2(last_pixel(light) + 1u) * vec2(grid.tiles) / vec2(grid.span);
    }
    return rectangle_vertex(vertex, first, end, vec2(grid.tiles));
}

#else

void visit(VisibleLight light, uvec2 tile);

#if defined(MANYLIGHTS_FRAGMENT)

layout(location = 0) flat in uint light_number;

void main() { visit(lights.d[light_number], uvec2(gl_FragCoord.xy)); }

#else

layout(local_size_x = 64) in;
const uint kGroupSize = 64u;
const uint kMany = 64u; // tiles

uint count_of(LightTiles tiles) { return tiles.size.x * tiles.size.y; }

// Row by row.
void visit_each(VisibleLight light, LightTiles tiles, uint start, uint stride) {
    for (uint i = start; i < count_of(tiles); i += stride)
        visit(light, tiles.first + uvec2(i % tiles.size.x, i / tiles.size.x));
}

void visit_many(uint first_light) {
    for (uint i = first_light; i < min(first_light + kGroupSize, light_count); ++i) {
        LightTiles tiles = tiles_of(lights.d[i]);
        if (count_of(tiles) > kMany) visit_each(lights.d[i], tiles, gl_LocalInvocationIndex, kGroupSize);
    }
}

void main() {
    visit_many(gl_WorkGroupID.x * kGroupSize);
    if (gl_GlobalInvocationID.x >= light_count) return;
    VisibleLight light = lights.d[gl_GlobalInvocationID.x];
    LightTiles tiles = tiles_of(light);
    if (count_of(tiles) <= kMany) visit_each(light, tiles, 0u, 1u);
}

#endif
#endif

#endif
