// Each pixel tests the lights of its sample's cluster.
#include "lab/techniques/shading_pass.glsl"

layout(std430, set = 0, binding = 6) readonly buffer Ids { uint d[]; }
ids; // per pixel of the image: its cluster
layout(std430, set = 0, binding = 7) readonly buffer Ranges { uvec2 d[]; }
ranges; // per cluster: first and end of its list
layout(std430, set = 0, binding = 8) readonly buffer References { uint d[]; }
references;

// The pixel's id and the cluster's range, in units of 16 bytes: four ids, then two ranges each.
uvec2 range_of(uint pixel) {
    uint cluster = ids.d[pixel];
    touch_node(pixel / 4u);
    touch_node((push.width * push.height + 3u) / 4u + cluster / 2u);
    return ranges.d[cluster];
}

void main() {
    Pixel pixel = begin_pixel(true);
    if (pixel.is_shaded) {
        uvec2 range = range_of(pixel.coordinates.y * push.width + pixel.coordinates.x);
        for (uint i = range.x; i < range.y; i += 1u) {
            uint light = references.d[i];
            touch_light(light);
            vec4 sphere = spheres.d[light];
            if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
        }
#if defined(MANYLIGHTS_RECORD)
        pixel.record.tested = pixel.record.references = range.y - range.x;
        pixel.record.nodes = 2u;
#endif
    }
    end_pixel(pixel);
}
