#pragma once
// The text of the wave cursor as C++: a thread per lane, emulated waves over handmade buffers.

#include "tests/shader/shader_text.h"

#include <barrier>

namespace manylights::test {

/// What the lanes of a workgroup share.
struct WaveGroup {
    const HandmadeBuffers& buffers;
    MlUint wave_size, few;
    std::vector<MlUint> words;
    std::barrier<> together;

    WaveGroup(const HandmadeBuffers& read, MlUint lanes, MlUint size, MlUint fewer)
        : buffers(read), wave_size(size), few(fewer), words(lanes), together(static_cast<std::ptrdiff_t>(lanes)) {}
};

struct WaveLane {
    WaveGroup& group;
    MlUint invocation; ///< in the workgroup
    int reads_outside = 0;

    template <typename T>
    T read(const std::vector<T>& from, MlUint i) {
        if (i < from.size()) return from[i];
        ++reads_outside;
        return T{};
    }

#define ML_COUNTERS
#define ML_SLICE_EDGE(i) read(group.buffers.slice_edges, i)
#define ML_CELL(i) read(group.buffers.cells, i)
#define ML_NODE(i) read(group.buffers.nodes, i)
#define ML_REFERENCE(i) read(group.buffers.references, i)
#define ML_WAVE_EMULATED
#define ML_WAVE_SIZE group.wave_size
#define ML_WAVE_GROUP_SIZE static_cast<MlUint>(group.words.size())
#define ML_WAVE_INDEX invocation
#define ML_WAVE_SHARED(i) group.words[i]
#define ML_WAVE_BARRIER() group.together.arrive_and_wait()
#define ML_WAVE_FEW group.few
#include <manylights/query.h>
#include <manylights/query_wave.h>
#undef ML_COUNTERS
#undef ML_SLICE_EDGE
#undef ML_CELL
#undef ML_NODE
#undef ML_REFERENCE
};

} // namespace manylights::test
