#version 460
#extension GL_GOOGLE_include_directive : require
// How each tile is cut anew: its slices are those of the producer between its first and its last point, merged in powers
// of two until there are few enough for the references that are left. One invocation per tile.
#include "lab/techniques/depth_windows/depth_shape.glsl"
#include "lab/techniques/depth_windows/depth_tile.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 2) readonly buffer Ranks { uint d[]; } ranks; // kept references before each
layout(std430, set = 0, binding = 3) readonly buffer Spans { uvec2 d[]; } spans;
layout(std430, set = 0, binding = 4) writeonly buffer Shapes { TileShape d[]; } shapes;
layout(std430, set = 0, binding = 5) writeonly buffer EntryCells { uint d[]; } entry_cells; // and a 0 behind the last

const uint kFlatReferences = 8u; // these two as in the producer
uint most_slices(uint count) { return max(count * 3u / 4u, 1u); }

// What is left of the classes: the units of one that is gone go with it.
MlTileForm form_of_classes(MlTileForm source, uint small_count, uint large_count) {
    MlTileForm form = source;
    form.two_classes = small_count != 0u && large_count != 0u ? 1u : 0u;
    form.small_shift = small_count != 0u ? source.small_shift : source.large_shift;
    form.large_shift = form.two_classes != 0u ? source.large_shift : 0u;
    form.wide = small_count + large_count > ML_WINDOW_NARROW_MAX ? 1u : 0u;
    form.flat_count = 0u;
    return form;
}

// Two slices are not worth a table.
uint merge_shift(uint last_slice, uint count) {
    uint most = count <= kFlatReferences ? 1u : most_slices(count);
    uint merge = 0u;
    while (last_slice >> merge >= most || last_slice >> merge == 1u) merge += 1u;
    return merge;
}

TileShape shape_of(SourceTile source, uvec2 span, uint small_count, uint large_count) {
    uint count = small_count + large_count;
    TileShape shape;
    shape.first_slice = span.x;
    shape.last_slice = span.y;
    shape.merge = merge_shift(span.y - span.x, count);
    shape.base_code = source.tile.base_code + (span.x << source.form.slice_shift);
    MlTileForm form = form_of_classes(source.form, small_count, large_count);
    form.slice_shift += shape.merge;
    form.last_slice = (span.y - span.x) >> shape.merge;
    if (form.last_slice == 0u && form.two_classes == 0u && count <= ML_TILE_FLAT_MAX) form.flat_count = count;
    shape.form = ml_pack_tile_form(form);
    if (shape.form == 0u) shape.form = 1u; // 0 says that there is no reference; one slice may be wider as well
    return shape;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    uint tile_count = views.d[0].tiles_x * views.d[0].tiles_y;
    if (index == tile_count) entry_cells.d[index] = 0u;
    if (index >= tile_count) return;
    SourceTile source = source_tile(index);
    uint first = source.tile.first_reference;
    uint small_count = ranks.d[first + source.small_count] - ranks.d[first];
    uint large_count = ranks.d[first + source.reference_count] - ranks.d[first + source.small_count];
    TileShape shape = TileShape(0u, 0u, 0u, 0u, 0u);
    if (small_count + large_count != 0u) shape = shape_of(source, spans.d[index], small_count, large_count);
    shapes.d[index] = shape;
    entry_cells.d[index] = shape.form != 0u ? ml_entry_cell_count(ml_tile_form(shape.form)) : 0u;
}
