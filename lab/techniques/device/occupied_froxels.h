#pragma once
// Which froxels hold points of the frame: a bit each, froxel i in bit i % 32 of word i / 32.

#include "lab/techniques/device/froxel_grid.h"

namespace manylights::lab {

class PointBuffer;

class OccupiedFroxels {
  public:
    explicit OccupiedFroxels(gpu::Device& device);

    /// Finds them and waits; the device's time in milliseconds.
    double find(const PointBuffer& points, const FroxelGrid& grid);

    const gpu::Buffer& bits() const { return bits_.buffer(); }

  private:
    gpu::Device& device_;
    gpu::ComputePipeline pipeline_;
    FittedBuffer bits_;
};

} // namespace manylights::lab
