#pragma once
// The five buffers of a structure in the library's format: written by a producer straight into mapped memory, read by
// the shaders, and by the host where a test or a picture asks for it.

#include "lab/gpu/buffer.h"
#include "lab/gpu/device.h"
#include "lab/techniques/producer.h"

#include <array>

namespace manylights::lab {

class StructureBuffers {
  public:
    explicit StructureBuffers(gpu::Device& device) : device_(device) {}

    /// Makes buffers of these sizes, filled with a pattern that no structure has, so that a byte which the producer
    /// forgets is noticed. Buffers that have these sizes already stay as they are: a repeated build has warm memory.
    void reserve(const ManylightsSizes& sizes);
    ManylightsBuffers targets() const; ///< where the producer writes
    void finish();                     ///< hands what was written to the device

    const std::array<const gpu::Buffer*, 5>& bindings() const { return bindings_; }
    std::uint64_t bytes() const { return bytes_; }
    /// Reads the buffer number i (order of ManylightsSizes) back.
    template <typename T>
    std::vector<T> host_copy(std::size_t i) const {
        return mapped_[i].template download<T>();
    }
    void overwrite_reference(std::uint64_t index, std::uint32_t light);

  private:
    gpu::Device& device_;
    std::vector<gpu::Buffer> mapped_;
    std::vector<gpu::Buffer> local_; ///< copies in the device's own memory; empty on a software device
    std::array<const gpu::Buffer*, 5> bindings_{};
    std::array<std::uint64_t, 5> sizes_{};
    std::uint64_t bytes_ = 0;
};

} // namespace manylights::lab
