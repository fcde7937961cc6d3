#pragma once
// Lists and light trees of the cells of a grid, built on the device from their references: sizes first, then nodes.

#include "lab/techniques/device_build/grid_references.h"
#include "lab/techniques/structure_options.h"

namespace manylights::lab {

/// The depths that the heuristics take for the ends of open slices.
struct DepthEnds {
    float near_depth, slice_far;
};

class CellTrees {
  public:
    CellTrees(gpu::Device& device, const StructureOptions& options);

    /// Builds them and waits; the device's time in milliseconds.
    double build(const CellGrid& grid, const VisibleLights& lights, const DepthOrder& order,
                 const GridReferences& references, const DepthEnds& ends);

    gpu::Buffer& nodes() { return nodes_.buffer(); } ///< MlNode each
    /// By cell: how many nodes it has, and which is its first.
    const gpu::Buffer& counts() const { return counts_.buffer(); }
    const gpu::Buffer& places() const { return places_.buffer(); }

  private:
    double find_sizes(const CellGrid& grid, const std::vector<gpu::Binding>& references, const gpu::Buffer& farthest,
                      const DepthEnds& ends);
    double write_nodes(const CellGrid& grid, std::vector<gpu::Binding> bindings);

    gpu::Device& device_;
    std::uint32_t leaf_size_;
    bool asks_cost_; ///< of every cell's tree, before it is decided on
    gpu::PrefixSum prefix_sum_;
    gpu::ComputePipeline cost_pipeline_, size_pipeline_, build_pipeline_;
    FittedBuffer costs_, kinds_, counts_, places_, total_, nodes_;
};

} // namespace manylights::lab
