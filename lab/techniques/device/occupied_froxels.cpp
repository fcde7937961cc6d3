#include "lab/techniques/device/occupied_froxels.h"

#include "lab/renderer/point_buffer.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kOccupiedCode[] =
#include "occupied_froxels.comp.inc"
    ;

constexpr std::uint32_t kGroupEdge = 8; // of the shader

struct Push {
    std::uint32_t width, height;
};

} // namespace

OccupiedFroxels::OccupiedFroxels(gpu::Device& device)
    : device_(device), pipeline_(device, {"froxels with points", kOccupiedCode, 3, sizeof(Push), {}}),
      bits_(device, "froxels with points") {}

double OccupiedFroxels::find(const PointBuffer& points, const FroxelGrid& grid) {
    bits_.fit(std::uint64_t{gpu::group_count(grid.froxel_count(), 32)} * sizeof(std::uint32_t));
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.fill(bits_.buffer(), 0);
    commands.barrier();
    commands.dispatch(pipeline_, {{points.positions()}, {grid.buffer()}, {bits_.buffer()}},
                      Push{points.width(), points.height()},
                      {gpu::group_count(points.width(), kGroupEdge), gpu::group_count(points.height(), kGroupEdge), 1});
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("froxels with points");
    return commands.milliseconds(start, end);
}

} // namespace manylights::lab
