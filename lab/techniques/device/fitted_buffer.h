#pragma once
// A buffer of a technique that builds on the device: made anew where its size changes, and then filled with a pattern
// that no structure has, so that a word which nobody writes is noticed. Of the same size it stays as it is: a repeated
// build has warm memory.

#include "lab/gpu/buffer.h"

#include <optional>

namespace manylights::lab {

constexpr std::uint32_t kPoison = 0xCDCDCDCD;

class FittedBuffer {
  public:
    FittedBuffer(gpu::Device& device, std::string name) : device_(device), name_(std::move(name)) {}

    const gpu::Buffer& fit(std::uint64_t bytes) {
        if (buffer_ && buffer_->bytes() == bytes) return *buffer_;
        buffer_.reset();
        buffer_.emplace(device_, name_, bytes);
        buffer_->fill(kPoison);
        return *buffer_;
    }

    /// Only after fit.
    const gpu::Buffer& buffer() const { return buffer_.value(); }
    gpu::Buffer& buffer() { return buffer_.value(); }

  private:
    gpu::Device& device_;
    std::string name_;
    std::optional<gpu::Buffer> buffer_;
};

} // namespace manylights::lab
