#include "lab/gpu/compute_pipeline.h"

#include "lab/gpu/held.h"
#include "lab/gpu/shader_layout.h"

namespace manylights::lab::gpu {

struct ComputePipeline::State {
    std::shared_ptr<Context> context;
    std::string name;
    ShaderLayout layout;
    vk::raii::Pipeline pipeline{nullptr};
};

namespace {

vk::raii::Pipeline make_pipeline(Context& context, const ComputeShader& shader, vk::PipelineLayout layout) {
    const vk::raii::ShaderModule module = make_shader_module(context, shader.code);
    const ShaderConstants constants(shader.specialization);
    vk::ComputePipelineCreateInfo info;
    info.stage.setStage(vk::ShaderStageFlagBits::eCompute)
        .setModule(*module)
        .setPName("main")
        .setPSpecializationInfo(constants.info());
    info.setLayout(layout);
    return vk::raii::Pipeline(context.vk(), nullptr, info);
}

} // namespace

ComputePipeline::ComputePipeline(Device& device, const ComputeShader& shader) {
    State state;
    state.context = device.context();
    state.name = shader.name;
    asking_for(*state.context, "making the compute pipeline '" + shader.name + "'", [&] {
        state.layout = make_shader_layout(*state.context, shader.buffer_count, shader.push_constant_bytes,
                                          vk::ShaderStageFlagBits::eCompute);
        state.pipeline = make_pipeline(*state.context, shader, *state.layout.pipeline);
    });
    state_ = make_held(std::move(state));
}

ComputePipeline::ComputePipeline(ComputePipeline&&) noexcept = default;
ComputePipeline& ComputePipeline::operator=(ComputePipeline&&) noexcept = default;
ComputePipeline::~ComputePipeline() = default;

const std::string& ComputePipeline::name() const { return state_->name; }
std::uint32_t ComputePipeline::buffer_count() const { return state_->layout.buffer_count; }
std::uint32_t ComputePipeline::push_constant_bytes() const { return state_->layout.push_constant_bytes; }
VkPipeline ComputePipeline::handle() const { return *state_->pipeline; }
VkPipelineLayout ComputePipeline::layout() const { return *state_->layout.pipeline; }
VkDescriptorSetLayout ComputePipeline::set_layout() const { return *state_->layout.set; }

} // namespace manylights::lab::gpu
