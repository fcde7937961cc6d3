// Brute force: every point tests every light of the dispatch. The lights stream through shared memory in chunks, four
// loads per thread; every thread takes part in every barrier, also where its pixel is sky or outside the image. No test
// is logged: every shaded lane tests all lights, so their union is known (brute_force.cpp).
#include "lab/techniques/shading_pass.glsl"

const uint kChunk = 256u; // kLightChunk of shading_pass.cpp
shared vec4 chunk[kChunk];

// The chunk's places behind the last light hold lights of range 0, which no point passes (the rule is strict).
void load_chunk(uint first) {
    for (uint i = gl_LocalInvocationIndex; i < kChunk; i += 64u)
        chunk[i] = first + i < push.end_light ? spheres.d[first + i] : vec4(0.0);
}

void main() {
    Pixel pixel = begin_pixel(push.first_light == 0u);
    for (uint first = push.first_light; first < push.end_light; first += kChunk) {
        load_chunk(first);
        barrier();
        if (pixel.is_shaded) {
            for (uint i = 0u; i < kChunk; i += 1u) {
                vec4 sphere = chunk[i];
                if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, first + i, sphere);
            }
        }
        barrier();
    }
#if defined(MANYLIGHTS_RECORD)
    if (pixel.is_shaded) pixel.record.tested += push.end_light - push.first_light;
#endif
    end_pixel(pixel);
}
