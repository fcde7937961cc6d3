#pragma once
// Exclusive prefix sums of 32-bit words on the device, for every technique that compacts or lays out there:
//
//     PrefixSum prefix_sum(device);
//     prefix_sum.reserve(count);
//     prefix_sum.record(commands, flags, places, count, total);   places[i] = flags[0] + ... + flags[i - 1]
//
// In levels: blocks are summed on their own, then the sums of the blocks, then both are added. No workgroup ever waits
// for another one, for Vulkan promises nothing of the kind.

#include "lab/gpu/commands.h"

#include <vector>

namespace manylights::lab::gpu {

class PrefixSum {
  public:
    static constexpr std::uint32_t kMaxCount = 1u << 26;

    explicit PrefixSum(Device& device);

    /// Room for sums over so many words, at most kMaxCount; never less than before. No commands that use it may be
    /// running, or be recorded and not yet done.
    void reserve(std::uint32_t count);

    /// Records the sums, modulo 2^32, of the first count words of `from` into `to`, which may be the same buffer, and
    /// the sum of all of them into the first word of `total`. With a barrier before and behind: nothing else is needed
    /// between the command that writes `from` and the one that reads the sums. Throws DeviceError where count exceeds
    /// what is reserved.
    void record(Commands& commands, const Buffer& from, const Buffer& to, std::uint32_t count, const Buffer& total);

  private:
    void add_levels(Commands& commands, const Buffer& to, std::uint32_t count) const;

    Device& device_;
    ComputePipeline blocks_pipeline_, add_pipeline_;
    std::uint32_t reserved_ = 0;
    std::vector<Buffer> levels_; ///< sums of the blocks of the words, of those sums, and so on
};

} // namespace manylights::lab::gpu
