// The references of a cell as ranks of lights in view: what the passes over cells read. Bindings 0 to 4.
#ifndef MANYLIGHTS_LAB_RANKED_LIGHTS_GLSL
#define MANYLIGHTS_LAB_RANKED_LIGHTS_GLSL

#include "lab/techniques/device/spread.glsl"
#include "lab/techniques/device/visible_light.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 1) readonly buffer Order { uint d[]; } order; // of lights in view, by rank
layout(std430, set = 0, binding = 2) readonly buffer Ranks { uint d[]; } ranks; // by reference
layout(std430, set = 0, binding = 3) readonly buffer Counts { uint d[]; } counts; // of references, by cell
layout(std430, set = 0, binding = 4) readonly buffer Places { uint d[]; } places; // of the first, by cell

const uint kNodeLights = 0xFFFFu; // a leaf counts 16 bits of lights
const uint kTreeLeaves = 16384u;  // the skip count of a tree's root has 15 bits
const uint kList = 1u, kTree = 2u; // kinds of cells; 0: no lights

// The nearest and the farthest depth of a reference's light.
vec2 depths_of(uint reference) {
    vec4 sphere = lights.d[order.d[ranks.d[reference]]].sphere;
    return vec2(sphere.z - sphere.w, sphere.z + sphere.w);
}

uint divide_up(uint value, uint by) { return value / by + (value % by != 0u ? 1u : 0u); }

uint next_power_of_two(uint value) { return value <= 1u ? 1u : 2u << findMSB(value - 1u); }

uint tree_leaves(uint light_count, uint leaf_size) { return next_power_of_two(divide_up(light_count, leaf_size)); }

#endif
