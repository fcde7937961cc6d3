#include "lab/techniques/device/tile_lists.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kListBuffers = 2; // of tile_lists.glsl; the technique's own follow

} // namespace

TileLists::TileLists(gpu::Device& device, const TilePassShader& shader)
    : lists_(device, shader.name),
      pass_(device, {shader.name + " (lists)", shader.code, kListBuffers + shader.buffer_count, shader.constants,
                     shader.billboards}) {}

double TileLists::build(const TileListsInput& input) {
    const auto record = [&](gpu::Commands& commands, const gpu::Buffer& counters, const gpu::Buffer& references,
                            bool is_fill) {
        std::vector<gpu::Binding> bindings{{counters}, {references}};
        for (const gpu::Binding& buffer : input.buffers) bindings.push_back(buffer);
        pass_.record(commands, input.pass, bindings, is_fill ? 1 : 0);
    };
    return lists_.build(input.pass.grid.tile_count() * input.lists_per_tile, input.words_per_reference, record);
}

} // namespace manylights::lab
