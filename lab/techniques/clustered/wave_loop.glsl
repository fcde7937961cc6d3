// Shading of lists by waves: the lanes walk the union of their cells' lists, which ascend, and each light that any of them
// has is loaded once, for all of them. Each step takes the least of the lanes' next lights; the lanes whose next it is
// test it and go on.
//
// Every lane goes through its own list whatever the others do: should the lists not ascend, or a wave fall apart into
// parts that walk on their own, lights are loaded more often, and none is lost.
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "lab/techniques/cursor_buffers.glsl"

const uint kNoLight = 0xFFFFFFFFu; // above every index: the format's limit is one less

uint next_light(inout MlCursor cursor) {
    uint light;
    return ml_next(cursor, light) ? light : kNoLight;
}

void main() {
    Pixel pixel = begin_pixel(true);
    MlCursor cursor;
    uint next = kNoLight; // lanes without a point have nothing to walk, and stay
    if (pixel.is_shaded) {
        cursor = ml_begin(views.d[0], vec2(pixel.coordinates) + 0.5, pixel.depth);
        next = next_light(cursor);
    }
    for (uint light = subgroupMin(next); light != kNoLight; light = subgroupMin(next)) {
        vec4 sphere = spheres.d[light];
        if (next == light) {
            if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
            next = next_light(cursor);
        }
    }
#if defined(MANYLIGHTS_RECORD)
    if (pixel.is_shaded) {
        pixel.record.tested = cursor.tested;
        pixel.record.nodes = cursor.nodes;
        pixel.record.references = cursor.references;
    }
#endif
    end_pixel(pixel);
}
