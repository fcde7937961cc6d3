#pragma once
// A pass in which every light in view goes over the tiles under its pixels. What becomes of a light in a tile is the
// technique's own text, the shader's function `visit`; where it puts the light, tile_lists.h or tile_links.h.

#include "lab/gpu/commands.h"
#include "lab/techniques/device/tile_grid.h"
#include "lab/techniques/device/visible_lights.h"

namespace manylights::lab {

struct TilePassShader {
    std::string name;                    ///< in messages
    std::span<const std::uint32_t> code; ///< of a compute shader, or of a fragment shader
    std::uint32_t buffer_count;          ///< from binding 1 on; the lights are before them
    std::vector<std::uint32_t> constants;
    std::span<const std::uint32_t> billboards{}; ///< with a fragment shader: the vertex shader
};

struct TilePassInput {
    const DeviceView& view;
    const TileGrid& grid;
    const VisibleLights& lights;
};

class TilePass {
  public:
    TilePass(gpu::Device& device, const TilePassShader& shader);

    /// buffers: from binding 1 on. word: the last push constant, whose name is the shader's.
    void record(gpu::Commands& commands, const TilePassInput& input, const std::vector<gpu::Binding>& buffers,
                std::uint32_t word) const;

  private:
    // One of the two.
    std::optional<gpu::ComputePipeline> compute_;
    std::optional<gpu::RasterPipeline> raster_;
};

} // namespace manylights::lab
