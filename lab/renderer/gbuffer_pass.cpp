#include "lab/renderer/gbuffer_pass.h"

#include "lab/gpu/commands.h"
#include "lab/gpu/device.h"
#include "lab/gpu/image.h"

#include <cstddef>
#include <optional>

namespace manylights::lab {

struct GBufferPass::State {
    gpu::Device& device;
    gpu::RasterPipeline pipeline;
    std::optional<gpu::Image> normal_and_material, depth;
};

namespace {

constexpr std::uint32_t kVertexCode[] =
#include "gbuffer.vert.inc"
    ;
constexpr std::uint32_t kFragmentCode[] =
#include "gbuffer.frag.inc"
    ;
constexpr VkFormat kSurfaceFormat = VK_FORMAT_R32G32B32A32_UINT;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

gpu::RasterPipeline make_pipeline(gpu::Device& device) {
    gpu::RasterShader shader;
    shader.name = "g-buffer";
    shader.vertex = kVertexCode;
    shader.fragment = kFragmentCode;
    shader.push_constant_bytes = sizeof(CameraAxes);
    shader.vertex_bytes = sizeof(Vertex);
    shader.attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
                         {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)},
                         {2, 0, VK_FORMAT_R32_UINT, offsetof(Vertex, material)}};
    gpu::RasterState state;
    state.color = kSurfaceFormat;
    state.depth = kDepthFormat;
    state.depth_passes = VK_COMPARE_OP_GREATER;
    state.writes_depth = true;
    return gpu::RasterPipeline(device, shader, state);
}

} // namespace

GBufferPass::GBufferPass(gpu::Device& device) : state_(new State{device, make_pipeline(device), {}, {}}) {}

GBufferPass::~GBufferPass() = default;

void GBufferPass::record(gpu::Commands& commands, const SceneBuffers& scene, const CameraAxes& camera,
                         std::uint32_t width, std::uint32_t height, const gpu::Buffer& depths,
                         const gpu::Buffer& normals) {
    State& state = *state_;
    const auto& context = state.device.context();
    state.normal_and_material.emplace(
        context, "normals and materials",
        gpu::ImageShape{width, height, kSurfaceFormat,
                        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    state.depth.emplace(context, "depth",
                        gpu::ImageShape{width, height, kDepthFormat,
                                        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    // Cleared to zero, which is the sky: a depth at infinity.
    commands.begin_drawing({width, height, {&*state.normal_and_material}, {&*state.depth}});
    if (scene.index_count > 0)
        commands.draw(state.pipeline, {scene.vertices, scene.indices, scene.index_count},
                      std::as_bytes(std::span(&camera, 1)));
    commands.end_drawing();
    commands.copy(*state.normal_and_material, normals);
    commands.copy(*state.depth, depths);
}

} // namespace manylights::lab
