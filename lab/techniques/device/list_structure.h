#pragma once
// Lists of tiles as a structure in the library's format, so that the library's query walks them: one slice, which holds
// all depths.

#include "lab/techniques/device/tile_lists.h"

#include <manylights/format.h>

namespace manylights::lab {

/// The one view of a structure that is built on the device; the first guess of a depth's slice is left 0.
MlView structure_view(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size, std::uint32_t slice_count,
                      MlUint structure);

class ListStructure {
  public:
    explicit ListStructure(gpu::Device& device);

    void fit(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size);
    /// In the order of structure_accessors.glsl.
    std::vector<const gpu::Buffer*> buffers(const TileLists& lists) const;

  private:
    FittedBuffer views_, nodes_;
    gpu::Buffer slice_edges_;
};

/// Of a structure's buffers together.
std::uint64_t bytes_of(const std::vector<const gpu::Buffer*>& buffers);

} // namespace manylights::lab
