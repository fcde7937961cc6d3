#pragma once
// Lists of lights of exactly the length that they need: the lights of each are counted, the counts summed, the sum read
// back, and the very same work done once more, which now writes.

#include "lab/gpu/prefix_sum.h"
#include "lab/techniques/device/fitted_buffer.h"

#include <functional>

namespace manylights::lab {

/// What goes over the lights. It adds 1 to a list's counter for each of its lights, which says the light's place, and
/// writes a reference there where is_fill, and else nothing. One shader for both, so that no compiler can make two of
/// the decision.
using CountedListsPass = std::function<void(gpu::Commands& commands, const gpu::Buffer& counters,
                                            const gpu::Buffer& references, bool is_fill)>;

class CountedLists {
  public:
    /// name: the technique's, in messages.
    CountedLists(gpu::Device& device, std::string name);

    /// Builds them and waits; the device's time in milliseconds. Throws InputError where their words do not fit 32
    /// bits.
    double build(std::uint32_t list_count, std::uint32_t words_per_reference, const CountedListsPass& pass);

    /// MlCell each. A list's lights are in no particular order.
    const gpu::Buffer& cells() const { return cells_.buffer(); }
    const gpu::Buffer& references() const { return references_.buffer(); }
    std::uint64_t reference_count() const { return reference_count_; }

  private:
    double count(std::uint32_t list_count, const CountedListsPass& pass);
    void check_total(std::uint32_t words_per_reference) const;
    double fill(std::uint32_t list_count, std::uint32_t words_per_reference, const CountedListsPass& pass);

    gpu::Device& device_;
    std::string name_;
    gpu::PrefixSum prefix_sum_;
    gpu::ComputePipeline cells_pipeline_;
    FittedBuffer counts_, places_, total_, cells_, references_;
    std::uint64_t reference_count_ = 0;
};

} // namespace manylights::lab
