#include "lab/techniques/octree/corner_table.h"

#include "lab/techniques/device/spread.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kCornersCode[] =
#include "octree_corners.comp.inc"
    ;

constexpr std::uint32_t kGroupSize = 64; // of the shader
constexpr std::uint64_t kCornerBytes = 16;

struct Push {
    DeviceView view;
    std::uint32_t corner_count;
};

} // namespace

CornerTable::CornerTable(gpu::Device& device)
    : device_(device), pipeline_(device, {"octree, corners", kCornersCode, 2, sizeof(Push), {}}),
      corners_(device, "corners of froxels") {}

double CornerTable::update(const Frame& frame, const DeviceView& view, const FroxelGrid& grid) {
    const Projection projection{view.right.w, view.down.w, view.forward.w, frame.scene.view_extent,
                                frame.width,  frame.height};
    if (projection_ == projection) return 0.0;
    projection_ = projection;
    const std::uint64_t count =
        (std::uint64_t{grid.tiles().tiles_x} + 1) * (grid.tiles().tiles_y + 1) * grid.slice_count();
    corners_.fit(count * kCornerBytes);
    const Push push{view, static_cast<std::uint32_t>(count)};
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(pipeline_, {{grid.buffer()}, {corners_.buffer()}}, push,
                      spread_groups(gpu::group_count(push.corner_count, kGroupSize)));
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("corners of froxels");
    return commands.milliseconds(start, end);
}

} // namespace manylights::lab
