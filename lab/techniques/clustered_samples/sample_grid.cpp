#include "lab/techniques/clustered_samples/sample_grid.h"

#include "lab/renderer/point_buffer.h"
#include "lab/techniques/device/depth_slices.h"

#include <fmt/format.h>

namespace manylights::lab {

namespace {

// Of the shaders.
constexpr std::uint32_t kPixelGroup = 16;
constexpr std::uint32_t kPatches = 55;

} // namespace

void SampleGrid::lay_out(const Frame& frame, const DeviceView& view, std::uint32_t tile_size, bool has_normals) {
    const CameraBasis basis = camera_basis(frame.camera, frame.width, frame.height);
    const float tile_slope = 2.0f * basis.tan_half_y * static_cast<float>(tile_size) / static_cast<float>(frame.height);
    const SliceEdges edges = self_similar_slices(frame.camera.near_plane, frame.scene.view_extent, 1.0f + tile_slope);
    tiles_y_ = gpu::group_count(frame.height, tile_size);
    push_ = {view, tile_size, gpu::group_count(frame.width, tile_size), slice_count(edges), has_normals ? kPatches : 1,
             0};
    slice_edges_.fit(edges.size() * sizeof(float));
    slice_edges_.buffer().upload(edges);
}

std::string SampleGrid::text() const {
    return fmt::format("{} tiles of {} slices and {} directions", tiles(), push_.slice_count, push_.patch_count);
}

std::array<std::uint32_t, 3> SampleGrid::groups_of_pixels() const {
    return {gpu::group_count(push_.view.width, kPixelGroup), gpu::group_count(push_.view.height, kPixelGroup), 1};
}

std::vector<gpu::Binding> SampleGrid::bindings(const Frame& frame, const std::vector<gpu::Binding>& more) const {
    std::vector<gpu::Binding> all{{frame.points.positions()}, {frame.points.normals()}, {slice_edges_.buffer()}};
    for (const gpu::Binding& binding : more) all.push_back(binding);
    return all;
}

} // namespace manylights::lab
