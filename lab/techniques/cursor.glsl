// Shading through the library's query: the same text for every structure that has the library's format.
#include "lab/techniques/structure_accessors.glsl"

// The second word of a reference of windows is what a point is compared with.
uint touched_reference(uint i) {
    if (views.d[0].structure == ML_STRUCTURE_WINDOWS && (i & 1u) != 0u) touch_check(i >> 1u);
    return references.d[i];
}

#define ML_REFERENCE(i) touched_reference(i)
#include <manylights/query.h>

void main() {
    Pixel pixel = begin_pixel(true);
    if (pixel.is_shaded) {
        MlCursor cursor = ml_begin(views.d[0], vec2(pixel.coordinates) + 0.5, pixel.depth);
        uint light;
        while (ml_next(cursor, light)) {
            touch_light(light);
            vec4 sphere = spheres.d[light];
            if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
        }
#if defined(MANYLIGHTS_RECORD)
        pixel.record.tested = cursor.tested;
        pixel.record.nodes = cursor.nodes;
        pixel.record.references = cursor.references;
#endif
    }
    end_pixel(pixel);
}
