#include "lab/techniques/device/tile_pass.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kGroupSize = 64; // of tile_pass.glsl

struct Push {
    DeviceView view;
    TileGrid grid;
    std::uint32_t light_count;
    std::uint32_t word;
};

} // namespace

TilePass::TilePass(gpu::Device& device, const TilePassShader& shader)
    : pipeline_(device, {shader.name, shader.code, 1 + shader.buffer_count, sizeof(Push), shader.constants}) {}

void TilePass::record(gpu::Commands& commands, const TilePassInput& input, const std::vector<gpu::Binding>& buffers,
                      std::uint32_t word) const {
    const std::uint32_t lights = input.lights.count();
    if (lights == 0) return;
    std::vector<gpu::Binding> bindings{{input.lights.lights()}};
    for (const gpu::Binding& buffer : buffers) bindings.push_back(buffer);
    commands.dispatch(pipeline_, bindings, Push{input.view, input.grid, lights, word},
                      {gpu::group_count(lights, kGroupSize), 1, 1});
}

} // namespace manylights::lab
