#pragma once
// The froxels of techniques that build on the device: cells of a tile of the image and a slice of depths, after Archer,
// Leach, Knowles and van Schyndel (2018) and Lamecki, Kaczmarek and Porter-Sobieraj (2022), who prescribe how many
// tiles there are. froxel_grid.glsl has what shaders ask of them.

#include "lab/techniques/device/depth_slices.h"
#include "lab/techniques/device/device_view.h"
#include "lab/techniques/device/fitted_buffer.h"
#include "lab/techniques/device/tile_grid.h"
#include "lab/techniques/options.h"

namespace manylights::lab {

enum class DepthDivision { exponential, view_uniform, screen_uniform };

struct FroxelOptions {
    std::array<std::uint32_t, 2> tiles{30, 17};
    DepthDivision division = DepthDivision::exponential;
    std::uint32_t slices = 0; ///< 0: exponential ones are as deep as a tile is high; of uniform ones there are 128
};

std::vector<OptionInfo> froxel_option_infos();
FroxelOptions read_froxel_options(const OptionReader& reader);

class FroxelGrid {
  public:
    explicit FroxelGrid(gpu::Device& device) : buffer_(device, "froxel grid") {}

    /// Slices begin at the camera's near plane and end at the scene's extent; the first is open towards the camera, the
    /// last one away from it. Throws InputError where more froxels are asked for than 32 bits number.
    void lay_out(const Frame& frame, const FroxelOptions& options);

    const TileGrid& tiles() const { return tiles_; }
    std::uint32_t slice_count() const { return slice_count_; }
    std::uint32_t froxel_count() const { return tiles_.tile_count() * slice_count_; }
    /// All of it, as froxel_grid.glsl reads it.
    const gpu::Buffer& buffer() const { return buffer_.buffer(); }

  private:
    FittedBuffer buffer_;
    TileGrid tiles_{};
    std::uint32_t slice_count_ = 0;
};

} // namespace manylights::lab
