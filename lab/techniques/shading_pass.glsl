// What the shading of a pixel has in common in every technique: the point, the common terms, the lights' contributions,
// the output. With MANYLIGHTS_RECORD the output is a PixelRecord, with MANYLIGHTS_LOG it is the words of touch_log.glsl
// for sampled blocks of pixels, else three floats.
//
// A technique says what it touches: touch_light before it tests a light, touch_node and touch_check where it reads a
// node or compares a reference, touch_batch where a wave culls together. Nothing but the log form looks at it.
#ifndef MANYLIGHTS_LAB_SHADING_PASS_GLSL
#define MANYLIGHTS_LAB_SHADING_PASS_GLSL

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

layout(local_size_x = 8, local_size_y = 8) in;

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
#if defined(MANYLIGHTS_RECORD)
layout(std430, set = 0, binding = 5) buffer Records { PixelRecord d[]; }
records;
#else
layout(std430, set = 0, binding = 5) buffer Radiance { float d[]; }
radiances;
#endif
#endif

// Rows [first_row, first_row + row_count) of the image; the output starts at the first of them. A dispatch whose first
// light is not light 0 adds to what earlier ones left in the output.
layout(push_constant) uniform Push {
    uint width, height;
    uint first_row, row_count;
    uint first_light, end_light;
    uint first_block; // of the log form: the sampled block of workgroup 0
}
push;

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

// is_first: nothing is in the output yet.
void begin_output(inout Pixel pixel, bool is_first) {
#if defined(MANYLIGHTS_RECORD)
    pixel.record = empty_record();
    if (pixel.is_inside && !is_first) pixel.record = records.d[pixel.output_index];
    if (pixel.is_shaded && is_first) {
        pixel.record.shaded = 1u;
        add_radiance(pixel.record, unlit_radiance(pixel.surface));
    }
#elif defined(MANYLIGHTS_LOG)
    if (pixel.is_inside) {
        log_place = log_places.d[pixel.output_index];
        log_end = log_ends.d[pixel.output_index];
    }
    if (pixel.is_shaded && is_first) touch(kTouchLane, 0u);
#else
    pixel.radiance = vec3(0.0);
    uint i = 3u * pixel.output_index;
    if (pixel.is_inside && !is_first) pixel.radiance = vec3(radiances.d[i], radiances.d[i + 1u], radiances.d[i + 2u]);
    if (pixel.is_shaded && is_first) pixel.radiance = unlit_radiance(pixel.surface);
#endif
}

// Which pixel this is, and where its output is.
void place_pixel(inout Pixel pixel) {
#if defined(MANYLIGHTS_LOG)
    uint sampled = push.first_block + gl_WorkGroupID.x;
    uint block = log_blocks.d[sampled];
    uint blocks_x = (push.width + 7u) / 8u;
    pixel.coordinates = uvec2(block % blocks_x, block / blocks_x) * 8u + gl_LocalInvocationID.xy;
    pixel.output_index = sampled * 64u + gl_LocalInvocationIndex;
    uint row = pixel.coordinates.y - push.first_row; // wraps above the band
#else
    pixel.coordinates = uvec2(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y + push.first_row);
    pixel.output_index = gl_GlobalInvocationID.y * push.width + gl_GlobalInvocationID.x;
    uint row = gl_GlobalInvocationID.y;
#endif
    pixel.is_inside = pixel.coordinates.x < push.width && row < push.row_count;
}

Pixel begin_pixel(bool is_first) {
    Pixel pixel;
    place_pixel(pixel);
    uint index = pixel.is_inside ? pixel.coordinates.y * push.width + pixel.coordinates.x : 0u;
    vec4 position = positions.d[index];
    pixel.depth = position.w;
    pixel.is_shaded = pixel.is_inside && position.w > 0.0;
    if (pixel.is_shaded) pixel.surface = load_surface(index, position.xyz);
    begin_output(pixel, is_first);
    return pixel;
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

void end_pixel(Pixel pixel) {
    if (!pixel.is_inside) return;
#if defined(MANYLIGHTS_RECORD)
    records.d[pixel.output_index] = pixel.record;
#elif defined(MANYLIGHTS_LOG)
    log_places.d[pixel.output_index] = log_place;
#else
    uint i = 3u * pixel.output_index;
    radiances.d[i] = pixel.radiance.x;
    radiances.d[i + 1u] = pixel.radiance.y;
    radiances.d[i + 2u] = pixel.radiance.z;
#endif
}

#endif
