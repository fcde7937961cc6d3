#pragma once
// Lists of lights, one or more per tile, of exactly the length that they need: lights are counted, the counts summed,
// the sum read back, and the very same shader goes over the lights once more and writes them. Which lights a tile's
// lists get is the technique's own text: it includes tile_lists.glsl and has a function of its own for a light and a
// tile.

#include "lab/gpu/prefix_sum.h"
#include "lab/techniques/device/fitted_buffer.h"
#include "lab/techniques/device/tile_pass.h"

namespace manylights::lab {

/// What the lists of an image are made of.
struct TileListsInput {
    TilePassInput pass;
    std::vector<gpu::Binding> buffers; ///< the technique's own
    std::uint32_t lists_per_tile = 1;
    std::uint32_t words_per_reference = 1;
};

class TileLists {
  public:
    /// shader: its text includes tile_lists.glsl; its own buffers are from binding 3 on.
    TileLists(gpu::Device& device, const TilePassShader& shader);

    /// Builds them and waits; the device's time in milliseconds. Throws InputError where their words do not fit 32
    /// bits.
    double build(const TileListsInput& input);

    /// MlCell each, tile by tile. A list's lights are in no particular order.
    const gpu::Buffer& cells() const { return cells_.buffer(); }
    const gpu::Buffer& references() const { return references_.buffer(); }
    std::uint64_t reference_count() const { return reference_count_; }

  private:
    double count(const TileListsInput& input, std::uint32_t lists);
    void check_total(std::uint32_t words_per_reference) const;
    double fill(const TileListsInput& input, std::uint32_t lists);
    void record_pass(gpu::Commands& commands, const TileListsInput& input, const gpu::Buffer& counters,
                     const gpu::Buffer& references, bool is_fill) const;

    gpu::Device& device_;
    std::string name_;
    gpu::PrefixSum prefix_sum_;
    TilePass pass_;
    gpu::ComputePipeline cells_pipeline_;
    FittedBuffer counts_, places_, total_, cells_, references_;
    std::uint64_t reference_count_ = 0;
};

} // namespace manylights::lab
