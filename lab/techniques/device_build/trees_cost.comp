#version 460
// What a depth can expect to pay for the tree of a cell, in tests of lights: every root is compared, every other node
// where its parent is hit, and a leaf's lights are tested where the leaf is hit; depths are uniform in the slice. For
// heuristic=d, which asks before the tree is built. A workgroup per cell; each lane has nodes of its own, whose bounds it
// finds from their lights.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device_build/ranked_lights.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 5) readonly buffer SliceEdges { float d[]; } slice_edges;
layout(std430, set = 0, binding = 6) readonly buffer Farthest { uint d[]; } farthest;
layout(std430, set = 0, binding = 7) writeonly buffer Costs { float d[]; } costs;
layout(push_constant) uniform Push {
    uint cell_count, tile_count, leaf_size;
    float near_depth, slice_far;
};
#include "lab/techniques/device_build/slice_extent.glsl"

const float kNodeCost = 0.5; // as reference/paper/tree.cpp has it
shared float lane_costs[64];

float hit_chance(vec2 depths, vec2 extent) {
    return max(min(depths.y, extent.y) - max(depths.x, extent.x), 0.0) / (extent.y - extent.x);
}

// Of the node with that number of its level, whose lights are a part of the cell's.
float node_cost(uint first, uint count, uint levels, uint level, uint number, vec2 extent) {
    uint leaves = 1u << (levels - 1u), per_leaf = divide_up(count, leaves);
    uint step = per_leaf << (levels - 1u - level);
    uint begin = min(number * step, count), end = min(begin + step, count);
    vec2 depths = vec2(3.4e38, -3.4e38);
    for (uint i = begin; i < end; ++i) {
        vec2 light = depths_of(first + i);
        depths = vec2(min(depths.x, light.x), max(depths.y, light.y));
    }
    float price = level + 1u == levels ? float(end - begin) : 2.0 * kNodeCost;
    return begin == end ? 0.0 : hit_chance(depths, extent) * price;
}

// Node i, counted level by level from the root: on the level of i + 1's highest bit.
float tree_cost(uint first, uint count, vec2 extent) {
    uint levels = findMSB(tree_leaves(count, leaf_size)) + 1u;
    float cost = gl_LocalInvocationIndex == 0u ? kNodeCost : 0.0;
    for (uint i = gl_LocalInvocationIndex; i < (1u << levels) - 1u; i += 64u) {
        uint level = findMSB(i + 1u);
        cost += node_cost(first, count, levels, level, i + 1u - (1u << level), extent);
    }
    return cost;
}

void main() {
    uint cell = spread_group();
    if (cell >= cell_count) return;
    vec2 extent = extent_of(cell / tile_count);
    uint most = kTreeLeaves * leaf_size, end = places.d[cell] + counts.d[cell];
    float cost = 0.0;
    for (uint first = places.d[cell]; first < end; first += min(end - first, most))
        cost += tree_cost(first, min(end - first, most), extent);
    lane_costs[gl_LocalInvocationIndex] = cost;
    for (uint step = 32u; step > 0u; step /= 2u) {
        barrier();
        if (gl_LocalInvocationIndex < step)
            lane_costs[gl_LocalInvocationIndex] += lane_costs[gl_LocalInvocationIndex + step];
    }
    if (gl_LocalInvocationIndex == 0u) costs.d[cell] = lane_costs[0];
}
