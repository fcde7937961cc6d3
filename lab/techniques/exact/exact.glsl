// Each pixel tests the lights of its own list, and they are those that affect its point.
#include "lab/techniques/shading_pass.glsl"

layout(std430, set = 0, binding = 6) readonly buffer Ranges { uvec2 d[]; }
ranges; // per pixel of the image: first and end of its list within the band's lights
layout(std430, set = 0, binding = 7) readonly buffer ListLights { uint d[]; }
list_lights; // of the band

void main() {
    Pixel pixel = begin_pixel(true);
    if (pixel.is_shaded) {
        uvec2 range = ranges.d[pixel.coordinates.y * push.width + pixel.coordinates.x];
        for (uint i = range.x; i < range.y; i += 1u) {
            uint light = list_lights.d[i];
            touch_light(light);
            vec4 sphere = spheres.d[light];
            if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
        }
#if defined(MANYLIGHTS_RECORD)
        pixel.record.tested = range.y - range.x;
        pixel.record.references = range.y - range.x;
#endif
    }
    end_pixel(pixel);
}
