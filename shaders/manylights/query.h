// Which lights may reach this point? A cursor over the buffers of a view; no bindings, the includer brings accessors:
//
//     #define ML_SLICE_EDGE(i) slice_edges.d[i]                        float
//     #define ML_CELL(i)       cells.d[i]                              MlCell
//     #define ML_NODE(i)       nodes.d[i]                              MlNode (or ml_node_from_words(nodes.d[i]))
//     #define ML_REFERENCE(i)  references.d[i]                         uint
//     #include <manylights/query.h>
//
//     MlCursor cursor = ml_begin(view, gl_FragCoord.xy, depth);
//     uint light;
//     while (ml_next(cursor, light))
//         if (ml_affects(point, center(light), range(light))) color += shade(light, point);
//
// depth is the view depth of the point: see manylights.h for what is promised to a (pixel, depth, point). Works for
// points on a surface, on translucent layers and in the air. Several cursors may live at once; leaving the loop early
// is fine.
//
// ML_COUNTERS: the cursor also counts what it does. In C++ the text may be included inside a class whose members the
// accessors name.
#ifndef MANYLIGHTS_FORMAT_H
#include <manylights/format.h>
#endif

struct MlCursor {
    MlUint reference; // the next one of the current leaf, list or window
    MlUint reference_end;
    MlUint
        node; // the next one of the current cell; windows: the first of the large references, until these are current
    MlUint node_end;
    float depth;
    MlUint structure;
    MlUint depth_code;  // of windows, like all that follow
    MlUint shift;       // of the current references' depths
    MlUint large_shift; // of those that come after them
    MlUint step_x;      // where in the tile
    MlUint step_y;
#if defined(ML_COUNTERS)
    MlUint tested;     // lights handed out
    MlUint nodes;      // cells and nodes read; windows: headers and entries
    MlUint references; // references read
#endif
};

// The slice of a depth. The logarithm only guesses: the edges decide, so the result is the same on every processor.
ML_FN MlUint ml_slice(ML_IN(MlView) view, float depth) {
    MlUint last = view.slice_count - 1u;
    if (last == 0u || !(depth >= ML_SLICE_EDGE(view.slice_offset + 1u))) return 0u;
#if defined(__cplusplus)
    float guess = std::log2(depth) * view.slice_scale + view.slice_bias;
#else
    float guess = log2(depth) * view.slice_scale + view.slice_bias;
#endif
    MlUint slice = guess >= float(last) ? last : (guess >= 1.0f ? MlUint(guess) : 1u);
    while (slice > 0u && depth < ML_SLICE_EDGE(view.slice_offset + slice)) slice -= 1u;
    while (slice < last && depth >= ML_SLICE_EDGE(view.slice_offset + slice + 1u)) slice += 1u;
    return slice;
}

// The pixel under a position along one axis, clamped to the image. Compared as floats first: an out of range conversion
// is undefined.
ML_FN MlUint ml_pixel(float position, MlUint size) {
    if (!(position > 0.0f)) return 0u;
    return position < float(size) ? MlUint(position) : size - 1u;
}

// The cell of a pixel and a depth; position in pixels, clamped to the image.
ML_FN MlUint ml_cell_index(ML_IN(MlView) view, MlFloat2 position, float depth) {
    MlUint tile_x = ml_pixel(position.x, view.width) / view.tile_px;
    MlUint tile_y = ml_pixel(position.y, view.height) / view.tile_px;
    MlUint slice = ml_slice(view, depth);
    return view.cell_offset + (slice * view.tiles_y + tile_y) * view.tiles_x + tile_x;
}

ML_FN void ml_begin_cell(ML_IN(MlView) view, MlFloat2 position, ML_INOUT(MlCursor) cursor) {
    MlCell cell = ML_CELL(ml_cell_index(view, position, cursor.depth));
#if defined(ML_COUNTERS)
    cursor.nodes += 1u;
#endif
    bool is_list = view.structure == ML_STRUCTURE_LISTS;
    cursor.reference = is_list ? cell.first : 0u;
    cursor.reference_end = is_list ? cell.first + cell.count : 0u;
    cursor.node = is_list ? 0u : cell.first;
    cursor.node_end = is_list ? 0u : cell.first + cell.count;
}

// The window of a slice, relative to the tile's first reference.
ML_FN MlWindow ml_read_window(ML_IN(MlTile) tile, ML_IN(MlTileForm) form, MlUint slice) {
    MlWindow window;
    window.small_first = window.large_first = window.large_last = 0u;
    window.small_last = form.flat_count;
    if (form.flat_count != 0u) return window;
    MlUint index = tile.first_entry + ml_entry_cell(form, slice);
    MlCell first = ML_CELL(index);
    MlCell second = first;
    if ((form.two_classes & form.wide) != 0u) second = ML_CELL(index + 1u);
    return ml_window_from_cells(form, slice, first, second);
}

// Windows: one header and one entry. Nothing is walked before the tile's first slice or behind its last.
ML_FN void ml_begin_tile(ML_IN(MlView) view, MlFloat2 position, ML_INOUT(MlCursor) cursor) {
    MlUint x = ml_pixel(position.x, view.width), y = ml_pixel(position.y, view.height);
    MlUint header = view.cell_offset + 2u * (y / view.tile_px * view.tiles_x + x / view.tile_px);
    MlTile tile = ml_tile_from_cells(ML_CELL(header), ML_CELL(header + 1u));
#if defined(ML_COUNTERS)
    cursor.nodes += 1u;
#endif
    MlTileForm form = ml_tile_form(tile.form);
    MlUint code = ml_depth_code(cursor.depth, view.depth_scale);
    MlUint slice = (code - tile.base_code) >> form.slice_shift;
    if (tile.form == 0u || code < tile.base_code || slice > form.last_slice) return;
    MlWindow window = ml_read_window(tile, form, slice);
#if defined(ML_COUNTERS)
    if (form.flat_count == 0u) cursor.nodes += 1u;
#endif
    cursor.reference = tile.first_reference + window.small_first;
    cursor.reference_end = tile.first_reference + window.small_last;
    cursor.node = tile.first_reference + window.large_first;
    cursor.node_end = tile.first_reference + window.large_last;
    cursor.depth_code = code;
    cursor.shift = form.small_shift;
    cursor.large_shift = form.large_shift;
    cursor.step_x = ml_tile_step(x % view.tile_px, view.tile_px);
    cursor.step_y = ml_tile_step(y % view.tile_px, view.tile_px);
}

ML_FN MlCursor ml_begin(ML_IN(MlView) view, MlFloat2 position, float depth) {
    MlCursor cursor;
    cursor.reference = cursor.reference_end = cursor.node = cursor.node_end = 0u;
    cursor.depth = depth;
    cursor.structure = view.structure;
    cursor.depth_code = cursor.shift = cursor.large_shift = cursor.step_x = cursor.step_y = 0u;
#if defined(ML_COUNTERS)
    cursor.tested = cursor.nodes = cursor.references = 0u;
#endif
    if (view.structure == ML_STRUCTURE_WINDOWS)
        ml_begin_tile(view, position, cursor);
    else
        ml_begin_cell(view, position, cursor);
    return cursor;
}

// Windows: a reference's bounds are read first; its light only where they hold the depth and the pixel.
ML_FN bool ml_next_in_windows(ML_INOUT(MlCursor) cursor, ML_OUT(MlUint) light) {
    light = 0u;
    while (cursor.reference != cursor.reference_end || cursor.node != cursor.node_end) {
        if (cursor.reference == cursor.reference_end) {
            cursor.reference = cursor.node;
            cursor.reference_end = cursor.node = cursor.node_end;
            cursor.shift = cursor.large_shift;
        }
        MlUint word = 2u * cursor.reference;
        MlUint bounds = ML_REFERENCE(word + 1u);
        cursor.reference += 1u;
#if defined(ML_COUNTERS)
        cursor.references += 1u;
#endif
        if (!ml_bounds_hold(bounds, cursor.depth_code >> cursor.shift, cursor.step_x, cursor.step_y)) continue;
        light = ML_REFERENCE(word);
#if defined(ML_COUNTERS)
        cursor.tested += 1u;
#endif
        return true;
    }
    return false;
}

// The next light that may reach the point. False: there is none left.
ML_FN bool ml_next(ML_INOUT(MlCursor) cursor, ML_OUT(MlUint) light) {
    if (cursor.structure == ML_STRUCTURE_WINDOWS) return ml_next_in_windows(cursor, light);
    light = 0u;
    while (cursor.reference == cursor.reference_end) {
        if (cursor.node >= cursor.node_end) return false;
        MlNode node = ML_NODE(cursor.node);
        bool hit = node.min_depth <= cursor.depth && cursor.depth <= node.max_depth;
        cursor.node += hit ? 1u : ml_node_skip_count(node.bits);
        if (hit && ml_node_is_leaf(node.bits)) {
            cursor.reference = node.first;
            cursor.reference_end = node.first + ml_node_light_count(node.bits);
        }
#if defined(ML_COUNTERS)
        cursor.nodes += 1u;
#endif
    }
    light = ML_REFERENCE(cursor.reference);
    cursor.reference += 1u;
#if defined(ML_COUNTERS)
    cursor.tested += 1u;
    cursor.references += 1u;
#endif
    return true;
}
