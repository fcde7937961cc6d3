#include "lab/techniques/device/tile_pass.h"

namespace manylights::lab {

namespace {

// Of tile_pass.glsl.
constexpr std::uint32_t kGroupSize = 64, kBillboardVertices = 6;

struct Push {
    DeviceView view;
    TileGrid grid;
    std::uint32_t light_count;
    std::uint32_t word;
};

} // namespace

TilePass::TilePass(gpu::Device& device, const TilePassShader& shader) {
    const std::uint32_t buffers = 1 + shader.buffer_count;
    if (shader.billboards.empty())
        compute_.emplace(device, gpu::ComputeShader{shader.name, shader.code, buffers, sizeof(Push), shader.constants});
    else
        raster_.emplace(
            device,
            gpu::RasterShader{
                shader.name, shader.billboards, shader.code, buffers, sizeof(Push), shader.constants, 0, {}},
            gpu::RasterState{});
}

void TilePass::record(gpu::Commands& commands, const TilePassInput& input, const std::vector<gpu::Binding>& buffers,
                      std::uint32_t word) const {
    const std::uint32_t lights = input.lights.count();
    if (lights == 0) return;
    std::vector<gpu::Binding> bindings{{input.lights.lights()}};
    for (const gpu::Binding& buffer : buffers) bindings.push_back(buffer);
    const Push push{input.view, input.grid, lights, word};
    if (compute_) {
        commands.dispatch(*compute_, bindings, push, {gpu::group_count(lights, kGroupSize), 1, 1});
        return;
    }
    commands.begin_drawing({input.grid.tiles_x, input.grid.tiles_y});
    commands.draw(*raster_, bindings, push, {kBillboardVertices, lights});
    commands.end_drawing();
}

} // namespace manylights::lab
