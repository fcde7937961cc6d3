#include "lab/renderer/gbuffer_pass.h"

#include "lab/gpu/commands.h"
#include "lab/gpu/held.h"
#include "lab/gpu/image.h"

#include <array>
#include <cstddef>

namespace manylights::lab {

struct GBufferPass::State {
    std::shared_ptr<gpu::Context> context;
    vk::raii::PipelineLayout layout{nullptr};
    vk::raii::Pipeline pipeline{nullptr};
    std::optional<gpu::Image> normal_and_material, depth;
};

namespace {

constexpr std::uint32_t kVertexCode[] =
#include "gbuffer.vert.inc"
    ;
constexpr std::uint32_t kFragmentCode[] =
#include "gbuffer.frag.inc"
    ;
constexpr vk::Format kSurfaceFormat = vk::Format::eR32G32B32A32Uint;
constexpr vk::Format kDepthFormat = vk::Format::eD32Sfloat;

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

template <std::size_t size>
vk::raii::ShaderModule make_module(const vk::raii::Device& device, const std::uint32_t (&code)[size]) {
    vk::ShaderModuleCreateInfo info;
    info.setCode(code);
    return vk::raii::ShaderModule(device, info);
}

vk::raii::PipelineLayout make_layout(const vk::raii::Device& device) {
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eVertex, 0, sizeof(CameraAxes));
    vk::PipelineLayoutCreateInfo info;
    info.setPushConstantRanges(push);
    return vk::raii::PipelineLayout(device, info);
}

constexpr vk::VertexInputBindingDescription kVertexBinding{0, sizeof(Vertex), vk::VertexInputRate::eVertex};
constexpr std::array<vk::VertexInputAttributeDescription, 3> kVertexAttributes{{
    {0, 0, vk::Format::eR32G32B32Sfloat, offsetof(Vertex, position)},
    {1, 0, vk::Format::eR32G32B32Sfloat, offsetof(Vertex, normal)},
    {2, 0, vk::Format::eR32Uint, offsetof(Vertex, material)},
}};

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device, vk::PipelineLayout layout) {
    const auto vertex = make_module(device, kVertexCode), fragment = make_module(device, kFragmentCode);
    const std::array<vk::PipelineShaderStageCreateInfo, 2> stages{
        {{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"},
         {{}, vk::ShaderStageFlagBits::eFragment, *fragment, "main"}}};
    vk::PipelineVertexInputStateCreateInfo input;
    input.setVertexBindingDescriptions(kVertexBinding).setVertexAttributeDescriptions(kVertexAttributes);
    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
    const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    vk::PipelineRasterizationStateCreateInfo raster;
    raster.setCullMode(vk::CullModeFlagBits::eNone).setLineWidth(1.0f);
    const vk::PipelineMultisampleStateCreateInfo samples({}, vk::SampleCountFlagBits::e1);
    const vk::PipelineDepthStencilStateCreateInfo depth({}, VK_TRUE, VK_TRUE, vk::CompareOp::eGreater);
    vk::PipelineColorBlendAttachmentState write_all;
    write_all.setColorWriteMask(vk::ColorComponentFlagBits::eR | vk::ColorComponentFlagBits::eG |
                                vk::ColorComponentFlagBits::eB | vk::ColorComponentFlagBits::eA);
    vk::PipelineColorBlendStateCreateInfo blend;
    blend.setAttachments(write_all);
    const std::array<vk::DynamicState, 2> changing{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    vk::PipelineDynamicStateCreateInfo dynamic;
    dynamic.setDynamicStates(changing);
    vk::PipelineRenderingCreateInfo targets;
    targets.setColorAttachmentFormats(kSurfaceFormat).setDepthAttachmentFormat(kDepthFormat);

    vk::GraphicsPipelineCreateInfo info;
    info.setStages(stages).setPVertexInputState(&input).setPInputAssemblyState(&assembly).setPViewportState(&viewport);
    info.setPRasterizationState(&raster).setPMultisampleState(&samples).setPDepthStencilState(&depth);
    info.setPColorBlendState(&blend).setPDynamicState(&dynamic).setLayout(layout).setPNext(&targets);
    return vk::raii::Pipeline(device, nullptr, info);
}

struct Transition {
    vk::ImageLayout from, to;
    vk::PipelineStageFlags2 from_stage, to_stage;
    vk::AccessFlags2 from_access, to_access;
};

vk::ImageMemoryBarrier2 image_barrier(const gpu::Image& image, const Transition& t) {
    const vk::ImageSubresourceRange whole(vk::ImageAspectFlags(image.aspect()), 0, 1, 0, 1);
    return {t.from_stage,
            t.from_access,
            t.to_stage,
            t.to_access,
            t.from,
            t.to,
            VK_QUEUE_FAMILY_IGNORED,
            VK_QUEUE_FAMILY_IGNORED,
            image.handle(),
            whole};
}

void record_barriers(vk::CommandBuffer command, const std::array<vk::ImageMemoryBarrier2, 2>& barriers,
                     const gpu::DeviceCalls& calls) {
    vk::DependencyInfo dependency;
    dependency.setImageMemoryBarriers(barriers);
    command.pipelineBarrier2(dependency, calls);
}

constexpr vk::PipelineStageFlags2 kDepthStages = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;

std::array<vk::ImageMemoryBarrier2, 2> to_attachments(const gpu::Image& color, const gpu::Image& depth) {
    return {image_barrier(color,
                          {vk::ImageLayout::eUndefined, vk::ImageLayout::eColorAttachmentOptimal,
                           Stage::eColorAttachmentOutput, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
                           Access::eColorAttachmentRead | Access::eColorAttachmentWrite}),
            image_barrier(depth, {vk::ImageLayout::eUndefined, vk::ImageLayout::eDepthAttachmentOptimal, kDepthStages,
                                  kDepthStages, Access::eDepthStencilAttachmentWrite,
                                  Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite})};
}

std::array<vk::ImageMemoryBarrier2, 2> to_copies(const gpu::Image& color, const gpu::Image& depth) {
    return {image_barrier(color, {vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::eTransferSrcOptimal,
                                  Stage::eColorAttachmentOutput, Stage::eCopy, Access::eColorAttachmentWrite,
                                  Access::eTransferRead}),
            image_barrier(depth,
                          {vk::ImageLayout::eDepthAttachmentOptimal, vk::ImageLayout::eTransferSrcOptimal, kDepthStages,
                           Stage::eCopy, Access::eDepthStencilAttachmentWrite, Access::eTransferRead})};
}

void begin_rendering(vk::CommandBuffer command, const gpu::Image& color, const gpu::Image& depth,
                     const gpu::DeviceCalls& calls) {
    // Zero is the sky: a depth at infinity.
    const vk::RenderingAttachmentInfo color_target(color.view(), vk::ImageLayout::eColorAttachmentOptimal,
                                                   vk::ResolveModeFlagBits::eNone, {}, vk::ImageLayout::eUndefined,
                                                   vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                                   vk::ClearColorValue(std::array<std::uint32_t, 4>{0, 0, 0, 0}));
    const vk::RenderingAttachmentInfo depth_target(depth.view(), vk::ImageLayout::eDepthAttachmentOptimal,
                                                   vk::ResolveModeFlagBits::eNone, {}, vk::ImageLayout::eUndefined,
                                                   vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                                   vk::ClearDepthStencilValue(0.0f, 0));
    const vk::Rect2D area({0, 0}, {color.width(), color.height()});
    vk::RenderingInfo info;
    info.setRenderArea(area).setLayerCount(1).setColorAttachments(color_target).setPDepthAttachment(&depth_target);
    command.beginRendering(info, calls);
    command.setViewport(0, vk::Viewport(0.0f, 0.0f, float(color.width()), float(color.height()), 0.0f, 1.0f), calls);
    command.setScissor(0, area, calls);
}

void record_copy(vk::CommandBuffer command, const gpu::Image& image, const gpu::Buffer& target,
                 const gpu::DeviceCalls& calls) {
    const vk::BufferImageCopy region(0, 0, 0, {vk::ImageAspectFlags(image.aspect()), 0, 0, 1}, {0, 0, 0},
                                     {image.width(), image.height(), 1});
    command.copyImageToBuffer(image.handle(), vk::ImageLayout::eTransferSrcOptimal, target.handle(), region, calls);
}

} // namespace

GBufferPass::GBufferPass(gpu::Device& device) {
    State state;
    state.context = device.context();
    gpu::asking_for(*state.context, "making the g-buffer's pipeline", [&] {
        state.layout = make_layout(state.context->vk());
        state.pipeline = make_pipeline(state.context->vk(), *state.layout);
    });
    state_ = gpu::make_held(std::move(state));
}

GBufferPass::~GBufferPass() = default;

void GBufferPass::record(gpu::Commands& commands, const SceneBuffers& scene, const CameraAxes& camera,
                         std::uint32_t width, std::uint32_t height, const gpu::Buffer& depths,
                         const gpu::Buffer& normals) {
    State& state = *state_;
    const auto color_usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc;
    const auto depth_usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eTransferSrc;
    state.normal_and_material.emplace(state.context, "normals and materials",
                                      gpu::ImageShape{width, height, VkFormat(kSurfaceFormat), VkFlags(color_usage)});
    state.depth.emplace(state.context, "depth",
                        gpu::ImageShape{width, height, VkFormat(kDepthFormat), VkFlags(depth_usage)});
    const gpu::Image &color = *state.normal_and_material, &depth = *state.depth;

    const vk::CommandBuffer command = commands.handle();
    const gpu::DeviceCalls& calls = *state.context->vk().getDispatcher();
    record_barriers(command, to_attachments(color, depth), calls);
    begin_rendering(command, color, depth, calls);
    if (scene.index_count > 0) {
        command.bindPipeline(vk::PipelineBindPoint::eGraphics, *state.pipeline, calls);
        command.pushConstants<CameraAxes>(*state.layout, vk::ShaderStageFlagBits::eVertex, 0, camera, calls);
        command.bindVertexBuffers(0, vk::Buffer(scene.vertices.handle()), vk::DeviceSize(0), calls);
        command.bindIndexBuffer(scene.indices.handle(), 0, vk::IndexType::eUint32, calls);
        command.drawIndexed(scene.index_count, 1, 0, 0, 0, calls);
    }
    command.endRendering(calls);
    record_barriers(command, to_copies(color, depth), calls);
    record_copy(command, color, normals, calls);
    record_copy(command, depth, depths, calls);
}

} // namespace manylights::lab
