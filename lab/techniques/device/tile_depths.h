#pragma once
// The least and the greatest depth of the points of each tile. Sky is no point: a tile of nothing else has the empty
// interval, whose first end is above the last.

#include "lab/techniques/device/fitted_buffer.h"
#include "lab/techniques/device/tile_grid.h"

namespace manylights::lab {

class PointBuffer;

class TileDepths {
  public:
    explicit TileDepths(gpu::Device& device);

    /// Finds them and waits; the device's time in milliseconds.
    double find(const PointBuffer& points, const TileGrid& grid);

    /// Two floats per tile: depths that the points themselves have, not rounded.
    const gpu::Buffer& depths() const { return depths_.buffer(); }

  private:
    gpu::Device& device_;
    gpu::ComputePipeline pipeline_;
    FittedBuffer depths_;
};

} // namespace manylights::lab
