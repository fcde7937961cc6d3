#pragma once
// Lists of lights, one or more per tile. Which lights a tile's lists get is the technique's own text: it includes
// tile_lists.glsl and has a function of its own for a light and a tile.

#include "lab/techniques/device/counted_lists.h"
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
    const gpu::Buffer& cells() const { return lists_.cells(); }
    const gpu::Buffer& references() const { return lists_.references(); }
    std::uint64_t reference_count() const { return lists_.reference_count(); }

  private:
    CountedLists lists_;
    TilePass pass_;
};

} // namespace manylights::lab
