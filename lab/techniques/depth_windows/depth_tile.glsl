// A tile of the producer's structure, as the passes of depth mode read it.
#ifndef MANYLIGHTS_LAB_DEPTH_TILE_GLSL
#define MANYLIGHTS_LAB_DEPTH_TILE_GLSL

#include <manylights/format.h>

layout(std430, set = 0, binding = 0) readonly buffer Views { MlView d[]; } views;
layout(std430, set = 0, binding = 1) readonly buffer Cells { MlCell d[]; } cells;

// The query's own function reads the windows; it asks for nothing else of a structure.
#define ML_CELL(i) cells.d[i]
#define ML_SLICE_EDGE(i) 0.0
#define ML_NODE(i) ml_node_from_words(uvec4(0u))
#define ML_REFERENCE(i) 0u
#include <manylights/query.h>

struct SourceTile {
    MlTile tile;
    MlTileForm form;
    uint small_count; // of its references
    uint reference_count;
};

SourceTile source_tile(uint index) {
    uint header = views.d[0].cell_offset + 2u * index;
    SourceTile source;
    source.tile = ml_tile_from_cells(cells.d[header], cells.d[header + 1u]);
    source.form = ml_tile_form(source.tile.form);
    source.small_count = source.reference_count = 0u;
    if (source.tile.form == 0u) return source;
    MlWindow last = ml_read_window(source.tile, source.form, source.form.last_slice);
    source.small_count = last.small_last;
    source.reference_count = source.form.two_classes != 0u ? last.large_last : last.small_last;
    return source;
}

#endif
