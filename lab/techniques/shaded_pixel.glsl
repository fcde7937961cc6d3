// A pixel that is shaded: its point, and what the lights that affect it add. For compute shaders (shading_pass.glsl) and
// for the fragments of rasterised lights alike: which pixel it is, and where the output goes, is the includer's.
//
// A technique says what it touches: touch_light before it tests a light, touch_node and touch_check where it reads a
// node or compares a reference, touch_batch where a wave culls together. Nothing but the log form looks at it.
#ifndef MANYLIGHTS_LAB_SHADED_PIXEL_GLSL
#define MANYLIGHTS_LAB_SHADED_PIXEL_GLSL

#include <manylights/format.h>

#include "lab/renderer/shading.glsl"

#if defined(MANYLIGHTS_RECORD)
#include "lab/techniques/record.glsl"
#endif
#if defined(MANYLIGHTS_LOG)
#include "lab/techniques/touch_log.glsl"
#else
void touch_light(uint light) {}
void touch_node(uint unit) {}
void touch_check(uint reference) {}
void touch_batch(uint batch) {}
#endif

struct PointNormal {
    vec3 normal;
    uint material;
};

layout(std430, set = 0, binding = 0) readonly buffer Positions { vec4 d[]; }
positions;
layout(std430, set = 0, binding = 3) readonly buffer Spheres { vec4 d[]; }
spheres;
#if !defined(MANYLIGHTS_LOG) // which has buffers of its own in these places
layout(std430, set = 0, binding = 1) readonly buffer Normals { PointNormal d[]; }
normals;
layout(std430, set = 0, binding = 2) readonly buffer Materials { MaterialRecord d[]; }
materials;
layout(std430, set = 0, binding = 4) readonly buffer Colors { vec4 d[]; }
colors;
#endif

struct Pixel {
    bool is_inside; // of the image
    bool is_shaded; // inside, and not sky
    uvec2 coordinates;
    uint output_index;
    float depth;
    Surface surface;
#if defined(MANYLIGHTS_RECORD)
    PixelRecord record;
#elif !defined(MANYLIGHTS_LOG)
    vec3 radiance;
#endif
};

// The log form asks where a surface is, and nothing else of it.
Surface load_surface(uint index, vec3 position) {
#if defined(MANYLIGHTS_LOG)
    Surface surface;
    surface.position = position;
    return surface;
#else
    PointNormal stored = normals.d[index];
    return make_surface(position, stored.normal, materials.d[stored.material]);
#endif
}

// The point of the pixel with this index, of those of the image.
void load_point(inout Pixel pixel, uint index) {
    vec4 position = positions.d[index];
    pixel.depth = position.w;
    pixel.is_shaded = pixel.is_inside && position.w > 0.0;
    if (pixel.is_shaded) pixel.surface = load_surface(index, position.xyz);
}

#if defined(MANYLIGHTS_LOG)
void shade_light(inout Pixel pixel, uint light, vec4 sphere) { touch(kTouchAffecting, light); }
void shade_colored_light(inout Pixel pixel, uint light, vec4 sphere, vec3 color) { touch(kTouchAffecting, light); }
#else
// A light that affects the pixel's point. N.L > 0 is decided with the stored normal and the direction as it is, summed in
// this order, so that every processor decides alike.
void shade_colored_light(inout Pixel pixel, uint light, vec4 sphere, vec3 color) {
    vec3 radiance = light_radiance(pixel.surface, sphere.xyz, sphere.w, color);
#if defined(MANYLIGHTS_RECORD)
    precise vec3 to_light = sphere.xyz - pixel.surface.position;
    vec3 normal = pixel.surface.normal;
    precise float cosine = normal.x * to_light.x + normal.y * to_light.y + normal.z * to_light.z;
    add_light(pixel.record, light, cosine > 0.0, radiance);
#else
    pixel.radiance += radiance;
#endif
}

void shade_light(inout Pixel pixel, uint light, vec4 sphere) {
    shade_colored_light(pixel, light, sphere, colors.d[light].rgb);
}
#endif

#endif
