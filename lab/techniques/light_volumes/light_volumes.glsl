// A fragment of a light's volume: whether the light affects the pixel's point, and what it adds. The image as a whole
// begins the output: what is there without any light.
#include "lab/techniques/light_volumes/volumes.glsl"
#include "lab/techniques/shaded_pixel.glsl"

layout(early_fragment_tests) in; // what is hidden by depth must not be in the output
layout(location = 0) flat in uint light_index;

#if defined(MANYLIGHTS_RECORD)
layout(std430, set = 0, binding = 5) buffer Records { PixelRecord d[]; }
records;
layout(std430, set = 0, binding = 5) buffer Words { uint d[]; }
words; // the same records, 16 words each

void add(uint word, uint value) {
    if (value != 0u) atomicAdd(words.d[word], value);
}

// Of 64 bits, in two halves: whoever makes the lower one overflow carries. The sum is right once all have added.
void add_long(uint word, int64_t value) {
    uint low = uint(value), high = uint(value >> 32);
    uint before = atomicAdd(words.d[word], low);
    add(word + 1u, high + (before + low < low ? 1u : 0u));
}

void begin_output(inout Pixel pixel) {
    pixel.record = empty_record();
    if (kShape != kImage) {
        pixel.record.tested = 1u;
        return;
    }
    if (pixel.is_shaded) {
        pixel.record.shaded = 1u;
        add_radiance(pixel.record, unlit_radiance(pixel.surface));
    }
    records.d[pixel.output_index] = pixel.record;
}

void end_output(Pixel pixel) {
    uint word = 16u * pixel.output_index;
    add(word, pixel.record.affecting);
    add(word + 1u, pixel.record.hash_a);
    add(word + 2u, pixel.record.hash_b);
    add(word + 3u, pixel.record.front);
    add(word + 4u, pixel.record.front_hash_a);
    add(word + 5u, pixel.record.front_hash_b);
    add(word + 6u, pixel.record.tested);
    for (uint i = 0u; i < 3u; ++i) add_long(word + 10u + 2u * i, pixel.record.radiance[i]);
}
#elif defined(MANYLIGHTS_LOG)
// The number of the first sampled block that is not before this one.
uint block_place(uint block) {
    uint first = 0u, end = uint(log_blocks.d.length());
    while (first < end) {
        uint middle = (first + end) / 2u;
        if (log_blocks.d[middle] < block)
            first = middle + 1u;
        else
            end = middle;
    }
    return first;
}

// Each fragment takes the places that it needs: the lane's point, or the light and that it affects the point.
void begin_output(inout Pixel pixel) {
    uvec2 block = pixel.coordinates / 8u, lane = pixel.coordinates % 8u;
    uint number = block.y * ((view.size.x + 7u) / 8u) + block.x, place = block_place(number);
    pixel.is_shaded = pixel.is_shaded && place < uint(log_blocks.d.length()) && log_blocks.d[place] == number;
    if (!pixel.is_shaded) return;
    pixel.output_index = 64u * place + 8u * lane.y + lane.x;
    vec4 sphere = spheres.d[light_index];
    bool is_pair = kShape != kImage && ml_affects(pixel.surface.position, sphere.xyz, sphere.w);
    log_place = atomicAdd(log_places.d[pixel.output_index], is_pair ? 2u : 1u);
    log_end = log_ends.d[pixel.output_index];
    if (kShape == kImage) touch(kTouchLane, 0u);
}

void end_output(Pixel pixel) {}
#else
layout(location = 0) out vec4 color;

void begin_output(inout Pixel pixel) {
    pixel.radiance = kShape == kImage && pixel.is_shaded ? unlit_radiance(pixel.surface) : vec3(0.0);
    color = vec4(pixel.radiance, 0.0);
}

void end_output(Pixel pixel) { color = vec4(pixel.radiance, 0.0); }
#endif

void main() {
    Pixel pixel;
    pixel.coordinates = uvec2(gl_FragCoord.xy);
    pixel.is_inside = true;
    pixel.output_index = pixel.coordinates.y * view.size.x + pixel.coordinates.x;
    load_point(pixel, pixel.output_index);
    begin_output(pixel);
    if (kShape == kImage || !pixel.is_shaded) return;
    touch_light(light_index);
    vec4 sphere = spheres.d[light_index];
    if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light_index, sphere);
    end_output(pixel);
}
