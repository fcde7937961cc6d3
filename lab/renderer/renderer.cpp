#include "lab/renderer/renderer.h"

#include "lab/gpu/commands.h"
#include "lab/gpu/device.h"
#include "lab/renderer/gbuffer_pass.h"
#include "lab/scene/error.h"

#include <string>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kPointsCode[] =
#include "points.comp.inc"
    ;

/// The push constants of points.comp.
struct PointsPush {
    CameraAxes camera;
    std::uint32_t width, height;
};
static_assert(sizeof(PointsPush) == 72);

CameraAxes camera_axes(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    const CameraBasis basis = camera_basis(camera, width, height);
    return {camera.position, camera.near_plane, basis.right,   basis.tan_half_x,
            basis.up,        basis.tan_half_y,  basis.forward, 0.0f};
}

} // namespace

struct Renderer::State {
    gpu::Device& device;
    SceneBuffers scene;
    GBufferPass gbuffer;
    gpu::ComputePipeline points;
};

Renderer::Renderer(gpu::Device& device, const Scene& scene)
    : state_(new State{device, SceneBuffers(device, scene), GBufferPass(device),
                       gpu::ComputePipeline(device, {"points", kPointsCode, 2, sizeof(PointsPush), {}})}) {}

Renderer::~Renderer() = default;

PointBuffer Renderer::render_points(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    PointBuffer points(state_->device, width, height, state_->scene.materials);
    render_points(camera, points);
    return points;
}

void Renderer::render_points(const Camera& camera, PointBuffer& target) {
    gpu::Device& device = state_->device;
    const std::uint32_t width = target.width(), height = target.height();
    const std::uint32_t limit = device.info().max_image_size;
    if (width > limit || height > limit)
        throw DeviceError("image size " + std::to_string(width) + "x" + std::to_string(height) + ": the device " +
                          device.info().name + " allows " + std::to_string(limit) + " pixels on a side");
    const gpu::Buffer depths(device, "depths", std::uint64_t(width) * height * sizeof(float));
    const CameraAxes axes = camera_axes(camera, width, height);

    gpu::Commands commands(device);
    state_->gbuffer.record(commands, state_->scene, axes, width, height, depths, target.normals());
    commands.barrier();
    commands.dispatch(state_->points, {{depths}, {target.positions()}}, PointsPush{axes, width, height},
                      {gpu::group_count(width, 8), gpu::group_count(height, 8), 1});
    commands.submit_and_wait("drawing the scene's points");
}

} // namespace manylights::lab
