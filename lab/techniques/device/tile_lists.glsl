// The pass of tile_lists.h, run twice: lists are counted, then written. The includer brings `visit` (tile_pass.glsl), which
// calls add_light; or, where a reference has more words, calls take_place once for each list that the light goes to, and
// writes a reference at that place where is_fill is not 0, and else nothing. One shader for both, so that no compiler can
// make two of the decision.
#ifndef MANYLIGHTS_LAB_TILE_LISTS_GLSL
#define MANYLIGHTS_LAB_TILE_LISTS_GLSL

#define TILE_PASS_WORD is_fill
#include "lab/techniques/device/tile_pass.glsl"

layout(std430, set = 0, binding = 1) buffer Counters { uint d[]; } counters; // lengths, or where the next one goes
layout(std430, set = 0, binding = 2) writeonly buffer References { uint d[]; } references;

uint take_place(uint list) { return atomicAdd(counters.d[list], 1u); }

void add_light(uint list, uint light) {
    uint place = take_place(list);
    if (is_fill != 0u) references.d[place] = light;
}

#endif
