#pragma once
// The corners of all froxels in the camera's axes. They stay as long as projection and grid do, wherever the camera
// goes.

#include "lab/techniques/device/froxel_grid.h"

#include <optional>

namespace manylights::lab {

class CornerTable {
  public:
    explicit CornerTable(gpu::Device& device);

    /// Computes them where projection or grid have changed, and waits; the device's time in milliseconds. The grid's
    /// options are always the same.
    double update(const Frame& frame, const DeviceView& view, const FroxelGrid& grid);

    const gpu::Buffer& corners() const { return corners_.buffer(); } ///< four floats each

  private:
    /// What corners depend on.
    struct Projection {
        float right, down, near_plane, view_extent;
        std::uint32_t width, height;
        bool operator==(const Projection&) const = default;
    };

    gpu::Device& device_;
    gpu::ComputePipeline pipeline_;
    FittedBuffer corners_;
    std::optional<Projection> projection_;
};

} // namespace manylights::lab
