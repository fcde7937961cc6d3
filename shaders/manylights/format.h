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
//
// Windows: slice_edges and nodes are empty, and the cells of a view are a header per tile, then the tiles' entries:
//
//   cells        MlTile, two cells per tile, x fastest  |  entries, per tile: the window of each of its slices
//     | first_entry ------------------------------------+    | first, last: relative to the tile's first_reference
//     | first_reference ----+                                |
//     v                     v                                v
//   references   two words per reference: uint light index, uint bounds (depth and rectangle)
//
// A slice's window holds every reference of its tile whose depths reach into the slice. Depths are integers there, by
// ml_depth_code on both sides: producer and reader cannot disagree at an edge. Tiles are in order without gaps: each
// has its references and its entries where those of the tile before end, the first of a view behind those of the view
// before (entries: behind the view's headers). From slice to slice a window's ends never go back, and no reference of a
// class is outside of all windows. The references of a class ascend by the slice of their near end: a window ends
// behind the last one that begins in its slice or before.
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
#define ML_STRUCTURE_WINDOWS 4u

// MlNode.bits: bit 31 leaf, bits 15 to 30 lights in the node (saturated in inner nodes), bits 0 to 14 skip count.
#define ML_NODE_LEAF 0x80000000u
#define ML_NODE_COUNT_SHIFT 15u
#define ML_NODE_COUNT_MAX 0xFFFFu
#define ML_NODE_SKIP_MAX 0x7FFFu

// Windows: depth codes have 24 bits; a tile has at most 256 slices, each axis of its rectangles 16 steps.
#define ML_DEPTH_CODE_MAX 0xFFFFFFu
#define ML_TILE_SLICES_MAX 256u
#define ML_TILE_FLAT_MAX 127u
#define ML_TILE_STEPS 16u
#define ML_WINDOW_NARROW_MAX 0xFFFFu // references of a tile whose entries are narrow

// One view, 64 bytes.
struct MlView {
    MlUint width; // pixels
    MlUint height;
    MlUint tile_px; // edge of a tile, pixels
    MlUint tiles_x;
    MlUint tiles_y;
    MlUint slice_count;  // 1 for trees, 0 for windows
    MlUint slice_offset; // of edge 0 in slice_edges. Slice s holds the depths in [edge s, edge s + 1); edge 0 is 0, the
                         // last +inf
    MlUint cell_offset;  // of the view's first cell
    MlUint cell_count;   // tiles_x * tiles_y * slice_count; windows: headers and entries together
    MlUint structure;    // ML_STRUCTURE_*
    float slice_scale;   // first guess of a depth's slice: floor(log2(depth) * slice_scale + slice_bias)
    float slice_bias;
    float depth_scale; // windows: depth codes per unit of depth, a power of two in [2^-126, 2^126]; else 0
    MlUint reserved1;  // zero
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

// Windows: a depth as an integer, monotone. The product with a power of two is exact, or both it and its flushed value
// are below 1, or infinite: the same code on every processor. Compared as floats first: an out of range conversion is
// undefined.
ML_FN MlUint ml_depth_code(float depth, float depth_scale) {
    float scaled = depth * depth_scale;
    if (!(scaled > 0.0f)) return 0u;
    return scaled < 16777216.0f ? MlUint(scaled) : ML_DEPTH_CODE_MAX;
}

// The header of a tile: two cells. The form is that of ml_pack_tile_form; it is 0 in tiles without references, and only
// there: where the form of a tile with references would be 0, its slice shift is 1. Without references base_code is 0,
// and both places are those where the next tile begins.
struct MlTile {
    MlUint first_reference; // absolute, in references (of two words)
    MlUint first_entry;     // absolute, in cells
    MlUint base_code;       // where slice 0 begins: no reference of the tile holds a lesser depth
    MlUint form;
};

ML_FN MlTile ml_tile_from_cells(MlCell first, MlCell second) {
    MlTile tile;
    tile.first_reference = first.first;
    tile.first_entry = first.count;
    tile.base_code = second.first;
    tile.form = second.count;
    return tile;
}

// How a tile is cut. Slice s holds the codes u with (u - base_code) >> slice_shift == s; no reference of the tile holds
// a depth behind the last slice. Small references come first in the tile, then the large ones. A flat tile has no
// entries: all its references are candidates in its one slice.
struct MlTileForm {
    MlUint slice_shift; // [0, 24]
    MlUint small_shift; // [0, 24], units of the depths in the bounds of small references; also of all, with one class
    MlUint large_shift; // likewise of large references; 0 with one class
    MlUint last_slice;  // 0 in flat tiles
    MlUint two_classes; // 0 or 1
    MlUint wide;        // 1: more than ML_WINDOW_NARROW_MAX references, entries of 32 bits
    MlUint flat_count;  // references of a flat tile, else 0
};

// From the low bits up: 5, 5, 5, 8, 1, 1 and 7 bits.
ML_FN MlUint ml_pack_tile_form(ML_IN(MlTileForm) form) {
    return form.slice_shift | (form.small_shift << 5u) | (form.large_shift << 10u) | (form.last_slice << 15u) |
           (form.two_classes << 23u) | (form.wide << 24u) | (form.flat_count << 25u);
}

ML_FN MlTileForm ml_tile_form(MlUint packed) {
    MlTileForm form;
    form.slice_shift = packed & 31u;
    form.small_shift = (packed >> 5u) & 31u;
    form.large_shift = (packed >> 10u) & 31u;
    form.last_slice = (packed >> 15u) & 255u;
    form.two_classes = (packed >> 23u) & 1u;
    form.wide = (packed >> 24u) & 1u;
    form.flat_count = packed >> 25u;
    return form;
}

// The window of a slice: its small and its large references, each [first, last), relative to the tile's first.
struct MlWindow {
    MlUint small_first;
    MlUint small_last;
    MlUint large_first;
    MlUint large_last;
};

// Where the entry of a slice begins, in cells from the tile's first.
//   one class    narrow: a word per slice, first | last << 16, two to a cell   wide: a cell {first, last}
//   two classes  narrow: a cell of such words {small, large}                   wide: two cells {first, last}
ML_FN MlUint ml_entry_cell(ML_IN(MlTileForm) form, MlUint slice) {
    return (slice << (form.two_classes + form.wide)) >> 1u;
}

// How many cells the entries of a tile take; an odd word at the end is 0.
ML_FN MlUint ml_entry_cell_count(ML_IN(MlTileForm) form) {
    MlUint words = (form.last_slice + 1u) << (form.two_classes + form.wide);
    return form.flat_count != 0u ? 0u : (words + 1u) >> 1u;
}

// first is the cell where the entry begins, second the one behind it: read only where both classes are wide.
ML_FN MlWindow ml_window_from_cells(ML_IN(MlTileForm) form, MlUint slice, MlCell first, MlCell second) {
    MlWindow window;
    MlUint word = form.two_classes == 0u && (slice & 1u) != 0u ? first.count : first.first;
    bool is_wide = form.wide != 0u;
    window.small_first = is_wide ? first.first : word & 0xFFFFu;
    window.small_last = is_wide ? first.count : word >> 16u;
    window.large_first = is_wide ? second.first : first.count & 0xFFFFu;
    window.large_last = is_wide ? second.count : first.count >> 16u;
    if (form.two_classes == 0u) window.large_last = window.large_first;
    return window;
}

// Which of the 16 steps of a tile's edge a pixel is in, by its distance from the tile's first: for producer and reader.
ML_FN MlUint ml_tile_step(MlUint pixel, MlUint tile_px) { return (pixel * ML_TILE_STEPS) / tile_px; }

// The bounds of a reference. low and high are depth codes >> the class's shift, at most 255 apart: low is kept modulo
// 256. x0 to x1 and y0 to y1 are the steps of the light's rectangle. From the low bits up: low 8, extent 8, then 4 bits
// each.
ML_FN MlUint ml_pack_bounds(MlUint low, MlUint high, MlUint x0, MlUint x1, MlUint y0, MlUint y1) {
    return (low & 255u) | ((high - low) << 8u) | (x0 << 16u) | (x1 << 20u) | (y0 << 24u) | (y1 << 28u);
}

// May the reference's light reach this depth code >> shift, at these steps? Never denies what low to high and the
// rectangle hold; 256 units farther or nearer it may confirm what they do not, which costs a test.
ML_FN bool ml_bounds_hold(MlUint bounds, MlUint depth, MlUint x, MlUint y) {
    bool in_depth = ((depth - bounds) & 255u) <= ((bounds >> 8u) & 255u);
    bool in_x = ((bounds >> 16u) & 15u) <= x && x <= ((bounds >> 20u) & 15u);
    bool in_y = ((bounds >> 24u) & 15u) <= y && y <= (bounds >> 28u);
    return in_depth && in_x && in_y;
}

#if defined(__cplusplus)
} // namespace manylights
#endif

#endif
