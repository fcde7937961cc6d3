#pragma once
// The five buffers of a structure in the library's format: written by a producer straight into mapped memory, read by
// the shaders, and by the host where a test or a picture asks for it.

#include "lab/gpu/buffer.h"
#include "lab/gpu/device.h"
#include "lab/techniques/producer.h"

#include <array>

namespace manylights::lab {

/// The five buffers of a structure on the device, in the order of ManylightsSizes, of exactly those sizes.
using StructureBindings = std::array<gpu::Buffer*, 5>;

class StructureBuffers {
  public:
    explicit StructureBuffers(gpu::Device& device) : device_(device) {}

    /// Makes buffers of these sizes, filled with a pattern that no structure has, so that a byte which the producer
    /// forgets is noticed. Buffers that have these sizes already stay as they are: a repeated build has warm memory.
    void reserve(const ManylightsSizes& sizes);
    ManylightsBuffers targets() const; ///< where the producer writes
    void finish();                     ///< hands what was written to the device

    const StructureBindings& bindings() const { return bindings_; }

  private:
    gpu::Device& device_;
    std::vector<gpu::Buffer> mapped_;
    std::vector<gpu::Buffer> local_; ///< copies in the device's own memory; empty on a software device
    StructureBindings bindings_{};
    std::array<std::uint64_t, 5> sizes_{};
};

} // namespace manylights::lab
