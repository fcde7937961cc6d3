// Shading through the list of the point's froxel: contiguous, or with MANYLIGHTS_LINKED link by link.
#include "lab/techniques/shading_pass.glsl"

#define FROXEL_BINDING 6
#include "lab/techniques/device/froxel_grid.glsl"

#if defined(MANYLIGHTS_LINKED)
#include "lab/techniques/device/light_link.glsl"
layout(std430, set = 0, binding = 7) readonly buffer Heads { uint d[]; }
heads; // the first link of each froxel
layout(std430, set = 0, binding = 8) readonly buffer Links { LightLink d[]; }
links;
const uint kListsPerUnit = 4u; // of 16 bytes
#else
layout(std430, set = 0, binding = 7) readonly buffer Cells { MlCell d[]; }
cells; // the list of each froxel
layout(std430, set = 0, binding = 8) readonly buffer References { uint d[]; }
references;
const uint kListsPerUnit = 2u;
#endif

void test_light(inout Pixel pixel, uint light) {
    touch_light(light);
#if defined(MANYLIGHTS_RECORD)
    pixel.record.tested += 1u;
    pixel.record.references += 1u;
#endif
    vec4 sphere = spheres.d[light];
    if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
}

void walk(inout Pixel pixel) {
    uint list = froxel_of(pixel.coordinates, pixel.depth);
    touch_node(list / kListsPerUnit);
#if defined(MANYLIGHTS_RECORD)
    pixel.record.nodes = 1u;
#endif
#if defined(MANYLIGHTS_LINKED)
    for (uint i = heads.d[list]; i != kNoLink; i = links.d[i].next) test_light(pixel, links.d[i].light);
#else
    MlCell cell = cells.d[list];
    for (uint i = cell.first; i < cell.first + cell.count; i += 1u) test_light(pixel, references.d[i]);
#endif
}

void main() {
    Pixel pixel = begin_pixel(true);
    if (pixel.is_shaded) walk(pixel);
    end_pixel(pixel);
}
