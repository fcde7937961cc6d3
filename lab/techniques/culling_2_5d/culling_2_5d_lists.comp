#version 460
// Which lights go to the lists of which tiles: those that reach into a cell with points.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/culling_2_5d/depth_cells.glsl"
#include "lab/techniques/device/tile_lists.glsl"

// As culling_2_5d.cpp numbers them.
layout(constant_id = 0) const uint variant = 0u;
layout(constant_id = 1) const uint cell_count = 32u;
layout(constant_id = 2) const uint is_whole = 0u; // the interval of the whole sphere, not of its part within the tile
const uint kMasks = 1u, kCells = 2u;

layout(std430, set = 0, binding = 3) readonly buffer Depths { vec2 d[]; } depths; // of tiles
layout(std430, set = 0, binding = 4) readonly buffer Scales { vec2 d[]; } scales;
layout(std430, set = 0, binding = 5) readonly buffer Occupied { uvec2 d[]; } occupied;

void add_with_mask(uint list, uint light, uvec2 mask) {
    uint words = cell_count > 32u ? 3u : 2u;
    uint place = words * take_place(list);
    if (is_fill == 0u) return;
    references.d[place] = light;
    references.d[place + 1u] = mask.x;
    if (words == 3u) references.d[place + 2u] = mask.y;
}

void add_to_cells(uint first_list, uint light, uvec2 mask) {
    for (uint cell = 0u; cell < cell_count; ++cell)
        if ((mask & cell_bit(cell)) != uvec2(0u)) add_light(first_list + cell, light);
}

void visit(VisibleLight light, uvec2 tile) {
    uint list = tile_index(grid, tile);
    vec2 points = depths.d[list];
    DepthSpan span = is_whole != 0u ? sphere_depths(light.sphere) : depths_in_tile(light, tile);
    span.low = max(span.low, points.x);
    span.high = min(span.high, points.y);
    if (span.low > span.high) return;
    uvec2 mask = cell_bits(depth_cell(span.low, scales.d[list], cell_count),
                           depth_cell(span.high, scales.d[list], cell_count)) &
                 occupied.d[list];
    if (mask == uvec2(0u)) return;
    if (variant == kCells)
        add_to_cells(list * cell_count, light.index, mask);
    else if (variant == kMasks)
        add_with_mask(list, light.index, mask);
    else
        add_light(list, light.index);
}
