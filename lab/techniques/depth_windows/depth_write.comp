#version 460
#extension GL_GOOGLE_include_directive : require
// Writes the structure of what is left: the view, each tile's header and entries, and its references. One workgroup per
// tile.
//
// An entry's new ends are the references kept before its old ones, so a window holds what is left of it, in the same
// order. The window of merged slices reaches from the begin of the first one to the end of the last.
#include "lab/techniques/depth_windows/depth_shape.glsl"
#include "lab/techniques/depth_windows/depth_tile.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 2) readonly buffer Ranks { uint d[]; } ranks; // kept references before each
layout(std430, set = 0, binding = 3) readonly buffer Shapes { TileShape d[]; } shapes;
layout(std430, set = 0, binding = 4) readonly buffer EntryPlaces { uint d[]; } entry_places; // entries before each tile
layout(std430, set = 0, binding = 5) readonly buffer References { uvec2 d[]; } references;
layout(std430, set = 0, binding = 6) writeonly buffer NewViews { MlView d[]; } new_views;
layout(std430, set = 0, binding = 7) writeonly buffer NewWords { uint d[]; } new_words; // two per cell
layout(std430, set = 0, binding = 8) writeonly buffer NewReferences { uvec2 d[]; } new_references;

const uint kLanes = 64u;

uint kept_before(SourceTile source, uint reference) {
    uint first = source.tile.first_reference;
    return ranks.d[first + reference] - ranks.d[first];
}

MlWindow new_window(SourceTile source, TileShape shape, uint slice) {
    uint first = shape.first_slice + (slice << shape.merge);
    uint last = min(first + (1u << shape.merge) - 1u, shape.last_slice);
    MlWindow near = ml_read_window(source.tile, source.form, first);
    MlWindow far = ml_read_window(source.tile, source.form, last);
    MlWindow window;
    window.small_first = kept_before(source, near.small_first);
    window.small_last = kept_before(source, far.small_last);
    window.large_first = window.large_last = window.small_last;
    if (source.form.two_classes == 0u) return window;
    window.large_first = kept_before(source, near.large_first);
    window.large_last = kept_before(source, far.large_last);
    if (kept_before(source, source.small_count) != 0u) return window;
    window.small_first = window.large_first; // the class that is left takes the place of both
    window.small_last = window.large_last;
    return window;
}

void write_entry(MlTileForm form, uint first_entry, uint slice, MlWindow window) {
    uint word = 2u * (first_entry + ml_entry_cell(form, slice));
    if (form.wide != 0u) {
        new_words.d[word] = window.small_first;
        new_words.d[word + 1u] = window.small_last;
        if (form.two_classes == 0u) return;
        new_words.d[word + 2u] = window.large_first;
        new_words.d[word + 3u] = window.large_last;
        return;
    }
    uint half_cell = form.two_classes == 0u ? slice & 1u : 0u;
    new_words.d[word + half_cell] = window.small_first | (window.small_last << 16u);
    if (form.two_classes != 0u) new_words.d[word + 1u] = window.large_first | (window.large_last << 16u);
    if (form.two_classes == 0u && slice == form.last_slice && half_cell == 0u) new_words.d[word + 1u] = 0u; // padding
}

void write_header(uint index, SourceTile source, TileShape shape, uint first_entry) {
    uint word = 4u * index;
    new_words.d[word] = ranks.d[source.tile.first_reference];
    new_words.d[word + 1u] = first_entry;
    new_words.d[word + 2u] = shape.base_code;
    new_words.d[word + 3u] = shape.form;
}

void write_references(SourceTile source) {
    uint begin = source.tile.first_reference, end = begin + source.reference_count;
    for (uint reference = begin + gl_LocalInvocationIndex; reference < end; reference += kLanes) {
        uint place = ranks.d[reference];
        if (ranks.d[reference + 1u] != place) new_references.d[place] = references.d[reference];
    }
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint index = gl_WorkGroupID.y * views.d[0].tiles_x + gl_WorkGroupID.x;
    uint header_cells = 2u * views.d[0].tiles_x * views.d[0].tiles_y;
    if (lane == 0u && index == 0u) {
        MlView view = views.d[0];
        view.cell_count = header_cells + entry_places.d[header_cells / 2u];
        new_views.d[0] = view;
    }
    SourceTile source = source_tile(index);
    TileShape shape = shapes.d[index];
    uint first_entry = header_cells + entry_places.d[index];
    if (lane == 0u) write_header(index, source, shape, first_entry);
    if (shape.form == 0u) return;
    MlTileForm form = ml_tile_form(shape.form);
    for (uint slice = lane; form.flat_count == 0u && slice <= form.last_slice; slice += kLanes)
        write_entry(form, first_entry, slice, new_window(source, shape, slice));
    write_references(source);
}
