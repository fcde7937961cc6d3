#pragma once
// Sorts pairs of a 32-bit key and a 32-bit value on the device, stable, by ascending key:
//
//     RadixSort sort(device);
//     sort.reserve(count);
//     sort.record(commands, keys, values, count, 20);   by the lowest 20 bits of the keys
//
// Least significant digit first, four bits to a pass: blocks count their digits, a prefix sum over all counts says
// where the keys of each digit and block begin, and each block deals its own keys out in order.

#include "lab/gpu/prefix_sum.h"

namespace manylights::lab::gpu {

class RadixSort {
  public:
    static constexpr std::uint32_t kMaxCount = 1u << 26;

    explicit RadixSort(Device& device);

    /// Room for so many pairs, at most kMaxCount; never less than before. No commands that use it may be running, or be
    /// recorded and not yet done.
    void reserve(std::uint32_t count);

    /// Records the sort of the first count pairs, in place, by the lowest key_bits (1 to 32) bits of the keys. Bits
    /// above may be compared as well: keys should have none. With a barrier before and behind. Throws DeviceError where
    /// count exceeds what is reserved.
    void record(Commands& commands, const Buffer& keys, const Buffer& values, std::uint32_t count,
                std::uint32_t key_bits);

  private:
    Device& device_;
    PrefixSum prefix_sum_;
    ComputePipeline count_pipeline_, scatter_pipeline_;
    std::uint32_t reserved_ = 0;
    std::vector<Buffer> scratch_; ///< keys, values, counts, total
};

} // namespace manylights::lab::gpu
