#pragma once
// The cells that samples are sorted into, as the passes over samples get them: samples.glsl.

#include "lab/gpu/commands.h"
#include "lab/techniques/device/device_view.h"
#include "lab/techniques/device/fitted_buffer.h"

namespace manylights::lab {

/// The push constants of samples.glsl.
struct SamplesPush {
    DeviceView view;
    std::uint32_t tile_size, tiles_x;
    std::uint32_t slice_count, patch_count;
    std::uint32_t cluster_count;
};
static_assert(sizeof(SamplesPush) == 84);

class SampleGrid {
  public:
    explicit SampleGrid(gpu::Device& device) : slice_edges_(device, "slice edges of clusters") {}

    /// Slices are as deep as a tile is wide where they begin.
    void lay_out(const Frame& frame, const DeviceView& view, std::uint32_t tile_size, bool has_normals);

    const SamplesPush& push() const { return push_; }
    std::uint32_t tiles() const { return push_.tiles_x * tiles_y_; }
    std::uint64_t keys_of_tile() const { return std::uint64_t{push_.slice_count} * push_.patch_count; }
    std::uint64_t keys() const { return keys_of_tile() * tiles(); }
    /// "2040 tiles of 254 slices and 1 directions", for messages.
    std::string text() const;

    std::array<std::uint32_t, 3> groups_of_pixels() const;
    std::array<std::uint32_t, 3> groups_of_tiles() const { return {push_.tiles_x, tiles_y_, 1}; }
    /// The samples' buffers, and more.
    std::vector<gpu::Binding> bindings(const Frame& frame, const std::vector<gpu::Binding>& more) const;

  private:
    FittedBuffer slice_edges_;
    SamplesPush push_{};
    std::uint32_t tiles_y_ = 0;
};

} // namespace manylights::lab
