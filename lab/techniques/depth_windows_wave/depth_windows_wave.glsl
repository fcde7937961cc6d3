// Shading through the library's wave cursor. Emulated waves are of constant 0's size.
#if defined(ML_WAVE_EMULATED)
layout(constant_id = 0) const uint kWaveSize = 64u;
#else
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#endif
#include "lab/techniques/structure_accessors.glsl"

#define ML_REFERENCE(i) references.d[i]
#include <manylights/query.h>

#if defined(ML_WAVE_EMULATED)
shared uint wave_words[64];
#define ML_WAVE_SIZE kWaveSize
#define ML_WAVE_GROUP_SIZE 64u
#define ML_WAVE_INDEX gl_LocalInvocationIndex
#define ML_WAVE_SHARED(i) wave_words[i]
#endif
#include <manylights/query_wave.h>

// Candidates that a wave culls together are a batch; few ones are compared by every lane for itself.
void touch_candidates(MlWaveCursor cursor, inout uint batch) {
    if (cursor.is_shared) touch_batch(batch++);
    if (cursor.is_shared) return;
    for (uint i = cursor.batch_first; i < cursor.next; ++i)
        touch_check(cursor.tile.first_reference + ml_wave_reference(cursor, i));
}

void main() {
    Pixel pixel = begin_pixel(true);
    MlWaveCursor cursor =
        ml_wave_begin(views.d[0], vec2(pixel.coordinates) + 0.5, pixel.depth, pixel.is_shaded);
    uint light, batch = 0u;
    while (ml_wave_next_batch(cursor)) {
#if defined(MANYLIGHTS_LOG)
        touch_candidates(cursor, batch);
#endif
        while (ml_wave_next(cursor, light)) {
            touch_light(light);
            vec4 sphere = spheres.d[light];
            if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
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
