#version 460
// Enters each light's rank into the bins that its depths reach, and writes the light of each rank.
//
// A span of bins is two overlapping spans of a power of two, whatever its length: the level of that power has them, and
// z_bins_level.comp hands them down to the bins. So a light costs the same whether it reaches one bin or all.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/visible_light.glsl"
#include "lab/techniques/z_bins/depth_bins.h"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 1) readonly buffer Order { uint d[]; } order;
// Per level and bin: the lowest rank, and the highest one inverted, so that both start at 0xFFFFFFFF and descend.
layout(std430, set = 0, binding = 2) buffer Levels { uvec2 d[]; } levels;
layout(std430, set = 0, binding = 3) writeonly buffer Ranked { uint d[]; } ranked;
layout(push_constant) uniform Push {
    DepthBins bins;
    uint light_count;
};

void enter(uint level, uint bin, uint rank) {
    uint place = level * bins.count + bin;
    atomicMin(levels.d[place].x, rank);
    atomicMin(levels.d[place].y, ~rank);
}

// The ends of the depths are moved outwards by what the camera's axes in floats (sphere_bounds.h) and a point's own
// depth, off by 2^-20 of itself, may be off.
void main() {
    uint rank = gl_GlobalInvocationID.x;
    if (rank >= light_count) return;
    VisibleLight light = lights.d[order.d[rank]];
    ranked.d[rank] = light.index;
    float depth = light.sphere.z, radius = light.sphere.w;
    float slack = 2e-6 * (abs(depth) + radius);
    uint first = bin_of(bins, depth - radius - slack), last = bin_of(bins, depth + radius + slack);
    uint level = findMSB(last - first + 1u);
    enter(level, first, rank);
    enter(level, last + 1u - (1u << level), rank);
}
