#pragma once
// Which keys of cells have samples, each once and in ascending order, and the place of each sample's key among them:
// the number of its cluster. Two ways on the device, with the same result to the last word.

#include "lab/gpu/prefix_sum.h"
#include "lab/techniques/clustered_samples/sample_grid.h"

namespace manylights::lab {

class UniqueKeys {
  public:
    explicit UniqueKeys(gpu::Device& device);
    virtual ~UniqueKeys() = default;

    /// Finds them and waits; the device's time in milliseconds. Throws InputError where the grid has more keys than the
    /// chosen way has room for.
    virtual double find(const Frame& frame, const SampleGrid& grid) = 0;

    std::uint32_t count() const { return count_; }
    const gpu::Buffer& keys() const { return keys_.buffer(); }
    const gpu::Buffer& ids() const { return ids_.buffer(); } ///< a word for each pixel, unused where it is sky

  protected:
    /// Before any pass: room for ids and totals, and the rule that holds for every way.
    void begin(const Frame& frame, const SampleGrid& grid, const char* way);
    /// Once the total is the number of keys.
    void count_keys();
    [[noreturn]] static void refuse(const SampleGrid& grid, const char* way, std::uint64_t most, const char* of);
    std::uint32_t total() const { return total_.buffer().download<std::uint32_t>(1).front(); }

    gpu::Device& device_;
    gpu::PrefixSum prefix_sum_;
    FittedBuffer ids_, keys_, total_;

  private:
    std::uint32_t count_ = 0;
};

/// The samples of each tile are sorted in workgroup memory.
std::unique_ptr<UniqueKeys> make_keys_by_sort(gpu::Device& device);
/// A bit for each key, or for each key of the pages that are in use.
std::unique_ptr<UniqueKeys> make_keys_by_bits(gpu::Device& device, bool is_paged);

} // namespace manylights::lab
