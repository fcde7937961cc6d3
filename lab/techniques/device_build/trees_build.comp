#version 460
// The nodes of each cell, a workgroup per cell: lists, or perfect binary trees bottom-up, written depth first at once.
// The place of a node in that order follows from its level and its number in the level. The levels of a tree go through
// the buffer itself, with a barrier between them, so that trees of all sizes are built alike.
#extension GL_GOOGLE_include_directive : require
#include <manylights/format.h>

#include "lab/techniques/device_build/ranked_lights.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kListBounds = 0u; // 1: of a list's node as of its lights, instead of infinite ones

layout(std430, set = 0, binding = 5) readonly buffer Kinds { uint d[]; } kinds;
layout(std430, set = 0, binding = 6) readonly buffer NodePlaces { uint d[]; } node_places;
layout(std430, set = 0, binding = 7) coherent buffer Nodes { MlNode d[]; } nodes;
layout(push_constant) uniform Push { uint cell_count, leaf_size; };

float infinity() { return uintBitsToFloat(0x7F800000u); }

uint leaf_bits(uint count) { return ML_NODE_LEAF | count << ML_NODE_COUNT_SHIFT; }

MlNode leaf_over(uint first, uint end) {
    vec2 bounds = vec2(infinity(), -infinity());
    for (uint i = first; i < end; ++i) {
        vec2 depths = depths_of(i);
        bounds = vec2(min(bounds.x, depths.x), max(bounds.y, depths.y));
    }
    return MlNode(bounds.x, bounds.y, first, leaf_bits(end - first) | 1u);
}

void write_list(uint node, uint first, uint end) {
    for (uint i = gl_LocalInvocationIndex; first + i * kNodeLights < end; i += 64u) {
        uint begin = first + i * kNodeLights;
        MlNode leaf = MlNode(-infinity(), infinity(), begin, leaf_bits(min(end - begin, kNodeLights)) | 1u);
        if (kListBounds != 0u) leaf = leaf_over(begin, min(begin + kNodeLights, end));
        nodes.d[node + i] = leaf;
    }
}

// Of a subtree whose root is on this level; the root of the tree is on level 0.
uint subtree_nodes(uint levels, uint level) { return (1u << (levels - level)) - 1u; }

// Depth first, from the root's place: at each step down past the parent, and to the right past the left subtree.
uint depth_first(uint levels, uint level, uint number) {
    uint place = 0u;
    for (uint child = 1u; child <= level; ++child) {
        uint is_right = (number >> (level - child)) & 1u;
        place += 1u + is_right * subtree_nodes(levels, child);
    }
    return place;
}

// Lights are dealt to the leaves in order, as evenly as whole numbers allow; what is left over of the power of two is
// padding that no depth hits.
void write_leaves(uint node, uint levels, uint first, uint count) {
    uint leaves = 1u << (levels - 1u), per_leaf = divide_up(count, leaves);
    for (uint leaf = gl_LocalInvocationIndex; leaf < leaves; leaf += 64u) {
        uint begin = min(leaf * per_leaf, count), end = min(begin + per_leaf, count);
        nodes.d[node + depth_first(levels, levels - 1u, leaf)] = leaf_over(first + begin, first + end);
    }
}

void write_parents(uint node, uint levels, uint level) {
    uint child_nodes = subtree_nodes(levels, level + 1u);
    for (uint i = gl_LocalInvocationIndex; i < 1u << level; i += 64u) {
        uint place = node + depth_first(levels, level, i);
        MlNode left = nodes.d[place + 1u], right = nodes.d[place + 1u + child_nodes];
        uint count = min(ml_node_light_count(left.bits) + ml_node_light_count(right.bits), ML_NODE_COUNT_MAX);
        nodes.d[place] = MlNode(min(left.min_depth, right.min_depth), max(left.max_depth, right.max_depth), left.first,
                                count << ML_NODE_COUNT_SHIFT | 2u * child_nodes + 1u);
    }
}

void write_tree(uint node, uint first, uint count) {
    uint levels = findMSB(tree_leaves(count, leaf_size)) + 1u;
    write_leaves(node, levels, first, count);
    for (uint level = levels - 1u; level-- > 0u;) {
        memoryBarrierBuffer();
        barrier();
        write_parents(node, levels, level);
    }
}

void main() {
    uint cell = spread_group();
    if (cell >= cell_count || kinds.d[cell] == 0u) return;
    uint node = node_places.d[cell], first = places.d[cell], end = first + counts.d[cell];
    if (kinds.d[cell] == kList) {
        write_list(node, first, end);
        return;
    }
    uint most = kTreeLeaves * leaf_size;
    for (; first < end; first += min(end - first, most)) {
        write_tree(node, first, min(end - first, most));
        node += 2u * kTreeLeaves - 1u; // of a tree behind which there is another one
    }
}
