#pragma once
// The shader text as C++, over handmade buffers. Reads outside of a buffer are counted, not made.

#include <manylights/format.h>

#include <cstdint>
#include <vector>

namespace manylights::test {

struct HandmadeBuffers {
    MlView frame_view{};
    std::vector<float> slice_edges;
    std::vector<MlCell> cells;
    std::vector<MlNode> nodes;
    std::vector<MlUint> references;
    int reads_outside = 0;

    template <typename T>
    T read(const std::vector<T>& from, MlUint i) {
        if (i < from.size()) return from[i];
        ++reads_outside;
        return T{};
    }

#define ML_COUNTERS
#define ML_SLICE_EDGE(i) read(slice_edges, i)
#define ML_CELL(i) read(cells, i)
#define ML_NODE(i) read(nodes, i)
#define ML_REFERENCE(i) read(references, i)
#include <manylights/query.h>
#undef ML_COUNTERS
#undef ML_SLICE_EDGE
#undef ML_CELL
#undef ML_NODE
#undef ML_REFERENCE
};

/// What a whole query came to.
struct Walk {
    std::vector<MlUint> lights;
    MlUint tested, nodes, references;
    MlUint node, node_end; ///< where the cursor stopped
};

inline Walk walk(HandmadeBuffers& buffers, float depth, MlFloat2 position = {0.5f, 0.5f}) {
    HandmadeBuffers::MlCursor cursor = buffers.ml_begin(buffers.frame_view, position, depth);
    Walk result{};
    MlUint light;
    while (buffers.ml_next(cursor, light)) result.lights.push_back(light);
    result.tested = cursor.tested;
    result.nodes = cursor.nodes;
    result.references = cursor.references;
    result.node = cursor.node;
    result.node_end = cursor.node_end;
    return result;
}

/// A light's range of depths.
struct DepthRange {
    float min, max;
};

/// One tile, one slice.
inline MlView one_cell_view(MlUint structure) {
    MlView view{};
    view.width = view.height = 1;
    view.tile_px = view.tiles_x = view.tiles_y = view.slice_count = view.cell_count = 1;
    view.structure = structure;
    return view;
}

inline MlNode make_leaf(DepthRange range, MlUint first, MlUint count) {
    return {range.min, range.max, first, ML_NODE_LEAF | (count << ML_NODE_COUNT_SHIFT) | 1u};
}

} // namespace manylights::test
