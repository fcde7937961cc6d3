#pragma once
// Reads the pipeline's buffers with the very text that shaders use.

#include "reference/paper/pipeline.h"

#include <manylights/format.h>

#include <cstdint>
#include <vector>

namespace manylights::paper {

// The query needs manylights/format.h before it, and its accessors name this class's members.
class Reader {
  public:
    explicit Reader(const Buffers& frame) : frame_(frame) {}

#define ML_COUNTERS
#define ML_SLICE_EDGE(i) frame_.slice_edges[i]
#define ML_CELL(i) frame_.cells[i]
#define ML_NODE(i) frame_.nodes[i]
#define ML_REFERENCE(i) frame_.references[i]
#include <manylights/query.h>
#undef ML_REFERENCE
#undef ML_NODE
#undef ML_CELL
#undef ML_SLICE_EDGE
#undef ML_COUNTERS

    struct Answer {
        std::vector<std::uint32_t> lights;
        std::uint32_t nodes = 0;
    };
    Answer ask(std::uint32_t view, MlFloat2 position, float depth) {
        Answer answer;
        MlCursor cursor = ml_begin(frame_.views[view], position, depth);
        std::uint32_t light = 0;
        while (ml_next(cursor, light)) answer.lights.push_back(light);
        answer.nodes = cursor.nodes;
        return answer;
    }

  private:
    const Buffers& frame_;
};

} // namespace manylights::paper
