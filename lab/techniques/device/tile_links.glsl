// The pass of tile_links.h. The includer brings `visit` (tile_pass.glsl), which calls add_light.
#ifndef MANYLIGHTS_LAB_TILE_LINKS_GLSL
#define MANYLIGHTS_LAB_TILE_LINKS_GLSL

#define TILE_PASS_WORD link_capacity
#include "lab/techniques/device/light_link.glsl"
#include "lab/techniques/device/tile_pass.glsl"

layout(std430, set = 0, binding = 1) buffer Heads { uint d[]; } heads; // the first link of each list
layout(std430, set = 0, binding = 2) writeonly buffer Links { LightLink d[]; } links;
layout(std430, set = 0, binding = 3) buffer Taken { uint count, wraps; } taken; // 64 bits of a number

// A link that the pool has no room for is counted, and no more.
void add_light(uint list, uint light) {
    uint link = atomicAdd(taken.count, 1u);
    if (link == 0xFFFFFFFFu) atomicAdd(taken.wraps, 1u);
    if (link < link_capacity) links.d[link] = LightLink(light, atomicExchange(heads.d[list], link));
}

#endif
