#pragma once
// The caller's settings, checked, with the defaults filled in.

#include "src/build/array.h"
#include "src/format/report.h"

#include <cstdint>

namespace manylights::detail {

constexpr std::uint32_t kMaxWorkers = 1024;

struct Settings {
    std::uint32_t structure;
    std::uint32_t tile_px;     // 0: windows choose it each frame
    std::uint32_t slice_count; // 1 for trees; windows have slices of their own
    std::uint32_t leaf_size;
    float slice_near;
    float slice_far;
    std::uint32_t max_workers;
    std::uint64_t max_bytes; // UINT64_MAX: no budget
    Allocator allocator;
    ManylightsParallelFor parallel_for; // null: in the calling thread
    void* parallel_user;
};

// given may be null.
Outcome resolve_settings(const ManylightsSettings* given, Settings& settings);

} // namespace manylights::detail
