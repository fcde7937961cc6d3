// What the shading of a pixel in a compute shader has in common in every technique: which pixel it is, and the output.
// With MANYLIGHTS_RECORD that is a PixelRecord, with MANYLIGHTS_LOG it is the words of touch_log.glsl for sampled blocks
// of pixels, else three floats.
#ifndef MANYLIGHTS_LAB_SHADING_PASS_GLSL
#define MANYLIGHTS_LAB_SHADING_PASS_GLSL

#include "lab/techniques/shaded_pixel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#if defined(MANYLIGHTS_RECORD)
layout(std430, set = 0, binding = 5) buffer Records { PixelRecord d[]; }
records;
#elif !defined(MANYLIGHTS_LOG)
layout(std430, set = 0, binding = 5) buffer Radiance { float d[]; }
radiances;
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
    load_point(pixel, index);
    begin_output(pixel, is_first);
    return pixel;
}

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
