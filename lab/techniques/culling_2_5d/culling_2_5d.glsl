// Shading through the lists of a tile whose references have masks of cells, or through the list of the point's cell.
#include "lab/techniques/culling_2_5d/depth_cells.glsl"
#include "lab/techniques/shading_pass.glsl"

layout(std430, set = 0, binding = 6) readonly buffer Grids { uint tile_size, tiles_x, cell_count, has_masks; }
cell_grid;
layout(std430, set = 0, binding = 7) readonly buffer Scales { vec2 d[]; } scales;
layout(std430, set = 0, binding = 8) readonly buffer Cells { MlCell d[]; } cells;
layout(std430, set = 0, binding = 9) readonly buffer References { uint d[]; } references;

// Units of 16 bytes: two scales, or two lists. Both kinds are numbered in turn, so that none is taken for the other.
vec2 touched_scale(uint tile) {
    touch_node(tile & ~1u);
    return scales.d[tile];
}

MlCell touched_list(uint list) {
    touch_node((list & ~1u) + 1u);
    return cells.d[list];
}

bool has_cell(uint place, uint cell) {
    return (references.d[place + 1u + cell / 32u] & (1u << (cell & 31u))) != 0u;
}

void main() {
    Pixel pixel = begin_pixel(true);
    if (pixel.is_shaded) {
        uvec2 tile_xy = pixel.coordinates / cell_grid.tile_size;
        uint tile = tile_xy.y * cell_grid.tiles_x + tile_xy.x;
        uint cell = depth_cell(pixel.depth, touched_scale(tile), cell_grid.cell_count);
        bool has_masks = cell_grid.has_masks != 0u;
        MlCell list = touched_list(has_masks ? tile : tile * cell_grid.cell_count + cell);
        uint words = !has_masks ? 1u : (cell_grid.cell_count > 32u ? 3u : 2u);
        uint tested = 0u;
        for (uint i = list.first; i < list.first + list.count; i += 1u) {
            if (has_masks) touch_check(i);
            if (has_masks && !has_cell(words * i, cell)) continue;
            uint light = references.d[words * i];
            touch_light(light);
            tested += 1u;
            vec4 sphere = spheres.d[light];
            if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
        }
#if defined(MANYLIGHTS_RECORD)
        pixel.record.tested = tested;
        pixel.record.nodes = 2u;
        pixel.record.references = list.count;
#endif
    }
    end_pixel(pixel);
}
