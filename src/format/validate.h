#pragma once
// Checks buffers of any producer against the layout of <manylights/format.h>: what a shader relies on to stay in
// bounds and to end, and what makes its answer complete and free of repeats.

#include "src/format/layout.h"
#include "src/format/report.h"

#include <cstdint>

namespace manylights::detail {

// Words of scratch that validate_buffers needs: a bit per light.
inline std::size_t mark_words(std::uint32_t light_count) { return divide_up(light_count, 32); }

// The pointers are aligned to 4, and null only where their size is 0.
Outcome validate_buffers(const ManylightsBuffers& buffers, const ManylightsSizes& sizes, std::uint32_t light_count,
                         std::uint32_t* marks);

inline Outcome damaged(const char* field, const char* rule, std::uint64_t index) {
    return {MANYLIGHTS_DAMAGED, field, rule, index};
}

// The buffers as arrays.
struct Contents {
    const MlView* views;
    const float* slice_edges;
    const MlCell* cells;
    const MlNode* nodes;
    const MlUint* references;
    Counts counts;
};

// The references of a cell or of a tile, those of a cell with nodes being their leaves' ranges joined without a gap.
struct ReferenceRange {
    std::uint64_t begin, end;
};

// No light of the references is unknown or there twice. marks: a bit per light, all 0 before and after.
Outcome validate_references(const Contents& contents, ReferenceRange range, std::uint32_t light_count,
                            std::uint32_t* marks);

// The nodes [first, first + count) of a cell, in bounds already, are complete trees in a row.
Outcome validate_nodes(const Contents& contents, MlCell cell, ReferenceRange& references);

// The cells and the references of windows; the views are sound already.
Outcome validate_windows(const Contents& contents, std::uint32_t light_count, std::uint32_t* marks);

} // namespace manylights::detail
