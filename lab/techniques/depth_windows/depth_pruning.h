#pragma once
// Depth mode: where a renderer has its points, passes on the device take what no point of a tile can need out of the
// windows that the producer wrote. README.md says how.

#include "lab/gpu/prefix_sum.h"
#include "lab/techniques/structure_technique.h"

#include <manylights/format.h>

#include <optional>

namespace manylights::lab {

class DepthPruning {
  public:
    explicit DepthPruning(gpu::Device& device);

    /// What is left of the windows of one view for these points, in buffers that stay until the next call.
    BuiltStructure prune(const PointBuffer& points, const BuiltStructure& built);
    double milliseconds() const { return milliseconds_; } ///< of the device, for the passes of the last call

  private:
    /// What the passes hand on.
    struct Scratch {
        Scratch(gpu::Device& device, std::uint32_t tiles, std::uint32_t references);

        std::uint32_t tile_count, reference_count;
        gpu::Buffer ranks; ///< kept references before each, and all behind the last; at first 1 where one is kept
        gpu::Buffer spans, shapes;
        gpu::Buffer entry_places; ///< likewise of cells with entries, per tile
        gpu::Buffer kept_references, kept_entries;
    };

    double count(const PointBuffer& points, const BuiltStructure& built, const MlView& view);
    void reserve(const std::array<std::uint64_t, 5>& bytes);
    double write(const BuiltStructure& built, const MlView& view);

    gpu::Device& device_;
    gpu::ComputePipeline mark_pipeline_, shape_pipeline_, write_pipeline_;
    gpu::PrefixSum prefix_sum_;
    std::optional<Scratch> scratch_;
    std::vector<gpu::Buffer> pruned_; ///< in the order of ManylightsSizes
    std::array<std::uint64_t, 5> pruned_bytes_{};
    double milliseconds_ = 0.0;
};

} // namespace manylights::lab
