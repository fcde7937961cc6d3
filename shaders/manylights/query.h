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
    MlUint reference; // the next one of the current leaf or list
    MlUint reference_end;
    MlUint node; // the next one of the current cell
    MlUint node_end;
    float depth;
#if defined(ML_COUNTERS)
    MlUint tested;     // lights handed out
    MlUint nodes;      // nodes read
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

ML_FN MlCursor ml_begin(ML_IN(MlView) view, MlFloat2 position, float depth) {
    MlCell cell = ML_CELL(ml_cell_index(view, position, depth));
    bool is_list = view.structure == ML_STRUCTURE_LISTS;
    MlCursor cursor;
    cursor.reference = is_list ? cell.first : 0u;
    cursor.reference_end = is_list ? cell.first + cell.count : 0u;
    cursor.node = is_list ? 0u : cell.first;
    cursor.node_end = is_list ? 0u : cell.first + cell.count;
    cursor.depth = depth;
#if defined(ML_COUNTERS)
    cursor.tested = 0u;
    cursor.nodes = 0u;
    cursor.references = 0u;
#endif
    return cursor;
}

// The next light that may reach the point. False: there is none left.
ML_FN bool ml_next(ML_INOUT(MlCursor) cursor, ML_OUT(MlUint) light) {
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
