#version 460
// Which cells get a list and which a tree (Tiled Light Trees, listing 2 and its readings), and how many nodes each has.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device_build/ranked_lights.glsl"

layout(local_size_x = 64) in;
// In the order of paper::Heuristic. Of trees without slices always, with one leaf as well.
layout(constant_id = 0) const uint kHeuristic = 0u;
layout(constant_id = 1) const uint kIsHybrid = 1u;
const uint kClippedHalfExtent = 0u, kDiameterExtent = 1u, kExpectedCost = 3u, kAlwaysTree = 4u, kAlwaysList = 5u;
const float kNodeCost = 0.5; // as reference/paper/tree.cpp has it

layout(std430, set = 0, binding = 5) readonly buffer SliceEdges { float d[]; } slice_edges;
layout(std430, set = 0, binding = 6) readonly buffer Farthest { uint d[]; } farthest;
layout(std430, set = 0, binding = 7) writeonly buffer Kinds { uint d[]; } kinds;
layout(std430, set = 0, binding = 8) writeonly buffer NodeCounts { uint d[]; } node_counts;
layout(std430, set = 0, binding = 9) readonly buffer Costs { float d[]; } costs; // of trees, for kExpectedCost alone
layout(push_constant) uniform Push {
    uint cell_count, tile_count, leaf_size;
    float near_depth, slice_far;
};

#include "lab/techniques/device_build/slice_extent.glsl"

bool prefers_tree(uint cell, uint count) {
    if (kHeuristic == kAlwaysTree || kHeuristic == kAlwaysList) return kHeuristic == kAlwaysTree;
    if (kHeuristic == kExpectedCost) return costs.d[cell] < kNodeCost + float(count);
    vec2 extent = extent_of(cell / tile_count);
    float sum = 0.0;
    for (uint i = places.d[cell]; i < places.d[cell] + count; ++i) {
        vec2 depths = depths_of(i);
        sum += kHeuristic == kDiameterExtent ? depths.y - depths.x
                                             : min(depths.y, extent.y) - max(depths.x, extent.x);
    }
    float limit = kHeuristic == kClippedHalfExtent ? 0.5 : 1.0;
    return sum / float(count) < limit * (extent.y - extent.x);
}

// Several trees in a row where one has not enough leaves.
uint tree_nodes(uint count) {
    uint most = kTreeLeaves * leaf_size, rest = count % most;
    return count / most * (2u * kTreeLeaves - 1u) + (rest == 0u ? 0u : 2u * tree_leaves(rest, leaf_size) - 1u);
}

void main() {
    uint cell = spread_index(64u);
    if (cell >= cell_count) return;
    uint count = counts.d[cell];
    bool is_tree = kIsHybrid == 0u || count > leaf_size && prefers_tree(cell, count);
    kinds.d[cell] = count == 0u ? 0u : (is_tree ? kTree : kList);
    node_counts.d[cell] = count == 0u ? 0u : (is_tree ? tree_nodes(count) : divide_up(count, kNodeLights));
}
