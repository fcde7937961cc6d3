// Shading by depth bins and masks of tiles: the ranks between those of the point's bin, as far as the tile's mask has
// them. MANYLIGHTS_WAVE: the lanes of a wave walk the ranks of all of them together, so that loads are uniform.
#if defined(MANYLIGHTS_WAVE) && !defined(MANYLIGHTS_LOG)
#extension GL_KHR_shader_subgroup_arithmetic : require
#endif
#include "lab/techniques/shading_pass.glsl"
#include "lab/techniques/z_bins/depth_bins.h"

layout(std430, set = 0, binding = 6) readonly buffer Header {
    DepthBins bins;
    uint tile_size, tiles_across;
    uint words;   // of a tile's mask
    uint summary; // words of a tile's summary; 0: there is none
}
header;
layout(std430, set = 0, binding = 7) readonly buffer Bins { uvec2 d[]; }
bins; // lowest rank, highest rank inverted; (0xFFFFFFFF, 0xFFFFFFFF): none
layout(std430, set = 0, binding = 8) readonly buffer Masks { uint d[]; }
masks; // a bit per rank, tile by tile
layout(std430, set = 0, binding = 9) readonly buffer Summaries { uint d[]; }
summaries; // a bit per word of the masks, tile by tile
layout(std430, set = 0, binding = 10) readonly buffer Ranked { uint d[]; }
ranked; // the light of each rank

struct Ranks {
    uint first, last; // none: first is above last
};

void read_node(inout Pixel pixel, uint unit) {
    touch_node(unit);
#if defined(MANYLIGHTS_RECORD)
    pixel.record.nodes += 1u;
#endif
}

// Units of 16 bytes: bins, masks, summaries, one behind the other.
uint units_of(uint words) { return words / 4u + uint(words % 4u != 0u); }
uint first_mask_unit() { return header.bins.count / 2u; }
uint first_summary_unit() { return first_mask_unit() + units_of(uint(masks.d.length())); }

Ranks ranks_of(inout Pixel pixel) {
    uint bin = bin_of(header.bins, pixel.depth);
    read_node(pixel, bin / 2u);
    return Ranks(bins.d[bin].x, ~bins.d[bin].y);
}

#if defined(MANYLIGHTS_WAVE) && defined(MANYLIGHTS_LOG)
layout(constant_id = 0) const uint kWaveSize = 64u; // 64 or 32
shared uint wave_first[2], wave_last[2];

// Of all lanes of the modelled wave, which is the workgroup or a half of it.
Ranks ranks_of_wave(Ranks own) {
    uint wave = gl_LocalInvocationIndex / kWaveSize;
    if (gl_LocalInvocationIndex < 2u) {
        wave_first[gl_LocalInvocationIndex] = 0xFFFFFFFFu;
        wave_last[gl_LocalInvocationIndex] = 0u;
    }
    barrier();
    atomicMin(wave_first[wave], own.first);
    atomicMax(wave_last[wave], own.last);
    barrier();
    return Ranks(wave_first[wave], wave_last[wave]);
}
#elif defined(MANYLIGHTS_WAVE)
// Tiles begin and end where workgroups do, so the lanes of a wave have one mask.
Ranks ranks_of_wave(Ranks own) { return Ranks(subgroupMin(own.first), subgroupMax(own.last)); }
#else
Ranks ranks_of_wave(Ranks own) { return own; }
#endif

// The bits of a word that stand for numbers of the range; the word holds one of them at least.
uint bits_between(uint word, uint first, uint last) {
    uint base = 32u * word, bits = 0xFFFFFFFFu;
    if (first > base) bits &= 0xFFFFFFFFu << (first - base);
    if (last - base < 31u) bits &= 0xFFFFFFFFu >> (31u - (last - base));
    return bits;
}

void test_lights(inout Pixel pixel, uint word, uint bits) {
    for (; bits != 0u; bits &= bits - 1u) {
        uint light = ranked.d[32u * word + uint(findLSB(bits))];
        touch_light(light);
#if defined(MANYLIGHTS_RECORD)
        pixel.record.tested += 1u;
        pixel.record.references += 1u;
#endif
        vec4 sphere = spheres.d[light];
        if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
    }
}

// unit: of 16 bytes, read last; words of the same one are read with it.
void walk_word(inout Pixel pixel, Ranks ranks, uint tile, uint word, inout uint unit) {
    uint place = tile * header.words + word;
    if (place / 4u != unit) {
        unit = place / 4u;
        read_node(pixel, first_mask_unit() + unit);
    }
    test_lights(pixel, word, masks.d[place] & bits_between(word, ranks.first, ranks.last));
}

void walk_summary(inout Pixel pixel, Ranks ranks, uint tile) {
    uint unit = 0xFFFFFFFFu, summary_unit = 0xFFFFFFFFu;
    uint first = ranks.first / 32u, last = ranks.last / 32u;
    for (uint group = first / 32u; group <= last / 32u; group += 1u) {
        uint place = tile * header.summary + group;
        if (place / 4u != summary_unit) {
            summary_unit = place / 4u;
            read_node(pixel, first_summary_unit() + summary_unit);
        }
        for (uint words = summaries.d[place] & bits_between(group, first, last); words != 0u; words &= words - 1u)
            walk_word(pixel, ranks, tile, 32u * group + uint(findLSB(words)), unit);
    }
}

void walk(inout Pixel pixel, Ranks ranks) {
    if (ranks.first > ranks.last) return;
    uvec2 at = pixel.coordinates / header.tile_size;
    uint tile = at.y * header.tiles_across + at.x;
    if (header.summary != 0u) {
        walk_summary(pixel, ranks, tile);
        return;
    }
    uint unit = 0xFFFFFFFFu;
    for (uint word = ranks.first / 32u; word <= ranks.last / 32u; word += 1u) walk_word(pixel, ranks, tile, word, unit);
}

void main() {
    Pixel pixel = begin_pixel(true);
#if defined(MANYLIGHTS_LOG)
    Ranks ranks = Ranks(0xFFFFFFFFu, 0u); // of a lane without a point: none
    if (pixel.is_shaded) ranks = ranks_of(pixel);
    ranks = ranks_of_wave(ranks);
    if (pixel.is_shaded) walk(pixel, ranks);
#else
    if (pixel.is_shaded) walk(pixel, ranks_of_wave(ranks_of(pixel)));
#endif
    end_pixel(pixel);
}
