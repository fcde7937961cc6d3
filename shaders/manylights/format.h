// The layout of the buffers that the library writes and the shaders read: one text for C++, GLSL and HLSL.
//
//   views        MlView per view
//     | cell_offset ------------------+            | slice_offset --> slice_edges   float, slice_count + 1 per view
//     v                               v
//   cells        MlCell, tile x fastest, then tile y, then slice
//     | lists: first, count ----------------------------+
//     | trees, hybrid: first, count                     |
//     v                                                 v
//   nodes        MlNode, depth first, per cell   -->  references   uint light index, per cell
//
// A light tree is a bounding interval hierarchy over view depth (O'Donnell and Chajdas, Tiled Light Trees, I3D 2017,
// sections 3.1 and 3.4, listing 1): depth first, walked forwards only. A node that misses the depth is left by adding
// its skip count to the node's index, any other by adding one (Smits 1998). A list is a tree of one leaf. A list of
// more than 65,535 lights is a run of leaves.
#ifndef MANYLIGHTS_FORMAT_H
#define MANYLIGHTS_FORMAT_H

#if defined(__cplusplus)
#include <bit>
#include <cmath>
#include <cstdint>
#define ML_FN inline
#define ML_IN(type) const type&
#define ML_INOUT(type) type&
#define ML_OUT(type) type&
namespace manylights {
using MlUint = std::uint32_t;
struct MlFloat2 {
    float x, y;
};
struct MlFloat3 {
    float x, y, z;
};
struct MlUint4 {
    MlUint x, y, z, w;
};
ML_FN float ml_as_float(MlUint bits) { return std::bit_cast<float>(bits); }
#define ML_PRECISE
// GLSL. The HLSL front end of glslang and glslc declares GL_core_profile as well: there, define ML_HLSL first.
#elif !defined(ML_HLSL) && (defined(GL_core_profile) || defined(GL_ES))
#define ML_FN
#define ML_IN(type) type
#define ML_INOUT(type) inout type
#define ML_OUT(type) out type
#define MlUint uint
#define MlFloat2 vec2
#define MlFloat3 vec3
#define MlUint4 uvec4
#define ml_as_float(bits) uintBitsToFloat(bits)
#define ML_PRECISE precise
#else
#define ML_FN
#define ML_IN(type) in type
#define ML_INOUT(type) inout type
#define ML_OUT(type) out type
#define MlUint uint
#define MlFloat2 float2
#define MlFloat3 float3
#define MlUint4 uint4
#define ml_as_float(bits) asfloat(bits)
#define ML_PRECISE precise
#endif

// What MlView.structure says of the cells: ranges of references, or ranges of nodes.
#define ML_STRUCTURE_LISTS 1u
#define ML_STRUCTURE_TREES 2u
#define ML_STRUCTURE_HYBRID 3u

// MlNode.bits: bit 31 leaf, bits 15 to 30 lights in the node (saturated in inner nodes), bits 0 to 14 skip count.
#define ML_NODE_LEAF 0x80000000u
#define ML_NODE_COUNT_SHIFT 15u
#define ML_NODE_COUNT_MAX 0xFFFFu
#define ML_NODE_SKIP_MAX 0x7FFFu

// One view, 64 bytes.
struct MlView {
    MlUint width; // pixels
    MlUint height;
    MlUint tile_px; // edge of a tile, pixels
    MlUint tiles_x;
    MlUint tiles_y;
    MlUint slice_count;  // 1 for trees
    MlUint slice_offset; // of edge 0 in slice_edges. Slice s holds the depths in [edge s, edge s + 1); edge 0 is 0, the
                         // last +inf
    MlUint cell_offset;  // of the view's first cell
    MlUint cell_count;   // tiles_x * tiles_y * slice_count
    MlUint structure;    // ML_STRUCTURE_*
    float slice_scale;   // first guess of a depth's slice: floor(log2(depth) * slice_scale + slice_bias)
    float slice_bias;
    MlUint reserved0; // zero
    MlUint reserved1;
    MlUint reserved2;
    MlUint reserved3;
};

// One cell, 8 bytes: lists: its references; trees and hybrid: its nodes.
struct MlCell {
    MlUint first;
    MlUint count;
};

// One tree node, 16 bytes. A padding leaf has min_depth = +inf, max_depth = -inf and no lights.
struct MlNode {
    float min_depth; // view depth, rounded towards -inf
    float max_depth; // rounded towards +inf
    MlUint first;    // the first of its references
    MlUint bits;
};

ML_FN MlNode ml_node_from_words(MlUint4 words) {
    MlNode node;
    node.min_depth = ml_as_float(words.x);
    node.max_depth = ml_as_float(words.y);
    node.first = words.z;
    node.bits = words.w;
    return node;
}

ML_FN bool ml_node_is_leaf(MlUint bits) { return (bits & ML_NODE_LEAF) != 0u; }
ML_FN MlUint ml_node_light_count(MlUint bits) { return (bits >> ML_NODE_COUNT_SHIFT) & ML_NODE_COUNT_MAX; }
ML_FN MlUint ml_node_skip_count(MlUint bits) { return bits & ML_NODE_SKIP_MAX; }

// The membership rule, and the only one: does this light's sphere contain this point? Both positions are relative to
// the camera: world position minus camera position, each difference rounded once to float. Strict, so a point on the
// surface is outside; no contraction to fused multiply-adds, so that every processor decides alike.
ML_FN bool ml_affects(MlFloat3 position, MlFloat3 center, float range) {
    ML_PRECISE float x = position.x - center.x;
    ML_PRECISE float y = position.y - center.y;
    ML_PRECISE float z = position.z - center.z;
    ML_PRECISE float squared_distance = x * x + y * y + z * z;
    ML_PRECISE float squared_range = range * range;
    return squared_distance < squared_range;
}

#if defined(__cplusplus)
} // namespace manylights
#endif

#endif
