#include "lab/gpu/raster_pipeline.h"

#include "lab/gpu/held.h"
#include "lab/gpu/shader_layout.h"

#include <array>

namespace manylights::lab::gpu {

struct RasterPipeline::State {
    std::shared_ptr<Context> context;
    std::string name;
    ShaderLayout layout;
    vk::raii::Pipeline pipeline{nullptr};
};

namespace {

vk::PipelineRasterizationStateCreateInfo rasterization_of(const RasterState& state) {
    vk::PipelineRasterizationStateCreateInfo info;
    info.setDepthClampEnable(state.clamps_depth).setCullMode(vk::CullModeFlags(state.cull)).setLineWidth(1.0f);
    return info;
}

vk::PipelineDepthStencilStateCreateInfo depth_of(const RasterState& state) {
    vk::PipelineDepthStencilStateCreateInfo info;
    info.setDepthTestEnable(state.depth != VK_FORMAT_UNDEFINED)
        .setDepthWriteEnable(state.writes_depth)
        .setDepthCompareOp(vk::CompareOp(state.depth_passes));
    return info;
}

vk::PipelineColorBlendAttachmentState blending_of(const RasterState& state) {
    using Channel = vk::ColorComponentFlagBits;
    vk::PipelineColorBlendAttachmentState blending;
    blending.setBlendEnable(state.adds_color)
        .setSrcColorBlendFactor(vk::BlendFactor::eOne)
        .setDstColorBlendFactor(vk::BlendFactor::eOne)
        .setSrcAlphaBlendFactor(vk::BlendFactor::eOne)
        .setDstAlphaBlendFactor(vk::BlendFactor::eOne)
        .setColorWriteMask(Channel::eR | Channel::eG | Channel::eB | Channel::eA);
    return blending;
}

void check_blending(const Context& context, const RasterShader& shader, const RasterState& state) {
    const auto features = context.physical->getFormatProperties(vk::Format(state.color)).optimalTilingFeatures;
    if (state.adds_color && !(features & vk::FormatFeatureFlagBits::eColorAttachmentBlend))
        throw DeviceError("pipeline '" + shader.name + "': the device " + context.info.name + " cannot add to " +
                          vk::to_string(vk::Format(state.color)) + " images");
}

vk::raii::Pipeline make_pipeline(Context& context, const RasterShader& shader, const RasterState& state,
                                 vk::PipelineLayout layout) {
    const vk::raii::ShaderModule vertex = make_shader_module(context, shader.vertex),
                                 fragment = make_shader_module(context, shader.fragment);
    const ShaderConstants constants(shader.specialization);
    const std::array<vk::PipelineShaderStageCreateInfo, 2> stages{
        {{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main", constants.info()},
         {{}, vk::ShaderStageFlagBits::eFragment, *fragment, "main", constants.info()}}};
    const vk::VertexInputBindingDescription vertices(0, shader.vertex_bytes, vk::VertexInputRate::eVertex);
    const std::vector<vk::VertexInputAttributeDescription> attributes(shader.attributes.begin(),
                                                                      shader.attributes.end());
    vk::PipelineVertexInputStateCreateInfo input;
    if (!attributes.empty()) input.setVertexBindingDescriptions(vertices).setVertexAttributeDescriptions(attributes);
    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
    const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    const vk::PipelineRasterizationStateCreateInfo raster = rasterization_of(state);
    const vk::PipelineMultisampleStateCreateInfo samples({}, vk::SampleCountFlagBits::e1);
    const vk::PipelineDepthStencilStateCreateInfo depth = depth_of(state);
    const vk::PipelineColorBlendAttachmentState blending = blending_of(state);
    const auto color_format = static_cast<vk::Format>(state.color);
    vk::PipelineColorBlendStateCreateInfo blend;
    vk::PipelineRenderingCreateInfo targets;
    if (state.color != VK_FORMAT_UNDEFINED) {
        blend.setAttachments(blending);
        targets.setColorAttachmentFormats(color_format);
    }
    targets.setDepthAttachmentFormat(vk::Format(state.depth));
    const std::array<vk::DynamicState, 2> changing{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    vk::PipelineDynamicStateCreateInfo dynamic;
    dynamic.setDynamicStates(changing);

    vk::GraphicsPipelineCreateInfo info;
    info.setStages(stages).setPVertexInputState(&input).setPInputAssemblyState(&assembly).setPViewportState(&viewport);
    info.setPRasterizationState(&raster).setPMultisampleState(&samples).setPDepthStencilState(&depth);
    info.setPColorBlendState(&blend).setPDynamicState(&dynamic).setLayout(layout).setPNext(&targets);
    return vk::raii::Pipeline(context.vk(), nullptr, info);
}

} // namespace

RasterPipeline::RasterPipeline(Device& device, const RasterShader& shader, const RasterState& raster) {
    State state;
    state.context = device.context();
    state.name = shader.name;
    asking_for(*state.context, "making the raster pipeline '" + shader.name + "'", [&] {
        check_blending(*state.context, shader, raster);
        state.layout = make_shader_layout(*state.context, shader.buffer_count, shader.push_constant_bytes,
                                          vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment);
        state.pipeline = make_pipeline(*state.context, shader, raster, *state.layout.pipeline);
    });
    state_ = make_held(std::move(state));
}

RasterPipeline::RasterPipeline(RasterPipeline&&) noexcept = default;
RasterPipeline& RasterPipeline::operator=(RasterPipeline&&) noexcept = default;
RasterPipeline::~RasterPipeline() = default;

const std::string& RasterPipeline::name() const { return state_->name; }
std::uint32_t RasterPipeline::buffer_count() const { return state_->layout.buffer_count; }
std::uint32_t RasterPipeline::push_constant_bytes() const { return state_->layout.push_constant_bytes; }
VkPipeline RasterPipeline::handle() const { return *state_->pipeline; }
VkPipelineLayout RasterPipeline::layout() const { return *state_->layout.pipeline; }
VkDescriptorSetLayout RasterPipeline::set_layout() const { return *state_->layout.set; }

} // namespace manylights::lab::gpu
