#pragma once
// The depth slices of a grid. A table of edges decides, on both sides; formulas only fill the table.

#include "reference/paper/options.h"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace manylights::paper {

class SliceTable {
  public:
    /// Makes the table; returns at once when nothing changed. slice_count 1 is a grid without slices.
    void update(const Options& options, std::uint32_t slice_count);

    /// The slice that ml_slice (query.h) finds for a finite depth; negative depths count as 0.
    std::uint32_t slice_of(float depth) const {
        const float inside = depth > 0.0f ? (depth < kLargest ? depth : kLargest) : 0.0f;
        std::uint32_t slice = first_slice_[std::bit_cast<std::uint32_t>(inside) >> kBinShift];
        slice += inside >= edges_[slice + 1]; // most often the only step, and not predictable
        while (inside >= edges_[slice + 1]) ++slice;
        return slice;
    }

    std::uint32_t count() const { return count_; }
    /// count() + 1 edges, the first 0, the last +inf.
    const std::vector<float>& edges() const { return edges_; }
    float guess_scale() const { return guess_scale_; } ///< MlView.slice_scale
    float guess_bias() const { return guess_bias_; }   ///< MlView.slice_bias

  private:
    void fill_edges(double near_edge, double far_edge, SliceFormula formula);
    void fill_bins();

    // 32 bins in each octave of depth: the float's sign, exponent and upper 5 mantissa bits.
    static constexpr std::uint32_t kBinShift = 18;
    static constexpr std::uint32_t kBinCount = (0x7F800000u >> kBinShift) + 1;
    static constexpr float kLargest = std::numeric_limits<float>::max();

    std::array<std::uint8_t, kBinCount> first_slice_{}; ///< slice of each bin's smallest depth
    std::vector<float> edges_;
    std::uint32_t count_ = 0;
    float near_ = 0.0f, far_ = 0.0f;
    SliceFormula formula_ = SliceFormula::corrected;
    float guess_scale_ = 0.0f, guess_bias_ = 0.0f;
};

} // namespace manylights::paper
