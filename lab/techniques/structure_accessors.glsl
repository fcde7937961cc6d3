// The buffers of a structure in the library's format, and what a query reads of them before it comes to references.
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

#define ML_SLICE_EDGE(i) slice_edges.d[i]
#define ML_CELL(i) touched_cell(i)
#define ML_NODE(i) touched_node(i)
