#include "lab/techniques/device/tile_depths.h"

#include "lab/renderer/point_buffer.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kDepthsCode[] =
#include "tile_depths.comp.inc"
    ;

struct Push {
    std::uint32_t width, height;
    TileGrid grid;
};

} // namespace

TileDepths::TileDepths(gpu::Device& device)
    : device_(device), pipeline_(device, {"depths of tiles", kDepthsCode, 2, sizeof(Push), {}}),
      depths_(device, "depths of tiles") {}

double TileDepths::find(const PointBuffer& points, const TileGrid& grid) {
    depths_.fit(std::uint64_t{grid.tile_count()} * 2 * sizeof(float));
    const Push push{points.width(), points.height(), grid};
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(pipeline_, {{points.positions()}, {depths_.buffer()}}, push, {grid.tiles_x, grid.tiles_y, 1});
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("depths of tiles");
    return commands.milliseconds(start, end);
}

} // namespace manylights::lab
