// The five buffers of the library's format and its query over them, which says what it touches.
#ifndef MANYLIGHTS_LAB_CURSOR_BUFFERS_GLSL
#define MANYLIGHTS_LAB_CURSOR_BUFFERS_GLSL

#include "lab/techniques/shading_pass.glsl"

layout(std430, set = 0, binding = 6) readonly buffer Views { MlView d[]; } views;
layout(std430, set = 0, binding = 7) readonly buffer SliceEdges { float d[]; } slice_edges;
layout(std430, set = 0, binding = 8) readonly buffer Cells { MlCell d[]; } cells;
layout(std430, set = 0, binding = 9) readonly buffer Nodes { uvec4 d[]; } nodes;
layout(std430, set = 0, binding = 10) readonly buffer References { uint d[]; } references;

// Units of 16 bytes: a node is one, and two cells are (of windows: a tile's header, or entries). Both kinds are numbered
// in turn, so that none is taken for the other.
MlNode touched_node(uint i) {
    touch_node(2u * i);
    return ml_node_from_words(nodes.d[i]);
}

MlCell touched_cell(uint i) {
    touch_node((i & ~1u) + 1u);
    return cells.d[i];
}

// The second word of a reference of windows is what a point is compared with.
uint touched_reference(uint i) {
    if (views.d[0].structure == ML_STRUCTURE_WINDOWS && (i & 1u) != 0u) touch_check(i >> 1u);
    return references.d[i];
}

#define ML_SLICE_EDGE(i) slice_edges.d[i]
#define ML_CELL(i) touched_cell(i)
#define ML_NODE(i) touched_node(i)
#define ML_REFERENCE(i) touched_reference(i)
#include <manylights/query.h>

#endif
