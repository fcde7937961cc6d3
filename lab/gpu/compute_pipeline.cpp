#include "lab/gpu/compute_pipeline.h"

#include "lab/gpu/held.h"

namespace manylights::lab::gpu {

struct ComputePipeline::State {
    std::shared_ptr<Context> context;
    std::string name;
    std::uint32_t buffer_count = 0;
    std::uint32_t push_constant_bytes = 0;
    vk::raii::DescriptorSetLayout set_layout{nullptr};
    vk::raii::PipelineLayout layout{nullptr};
    vk::raii::Pipeline pipeline{nullptr};
};

namespace {

vk::raii::DescriptorSetLayout make_set_layout(Context& context, std::uint32_t buffer_count) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t binding = 0; binding < buffer_count; ++binding)
        bindings.emplace_back(binding, vk::DescriptorType::eStorageBuffer, 1u, vk::ShaderStageFlagBits::eCompute);
    vk::DescriptorSetLayoutCreateInfo info;
    info.setBindings(bindings);
    return vk::raii::DescriptorSetLayout(context.vk(), info);
}

vk::raii::PipelineLayout make_layout(Context& context, vk::DescriptorSetLayout set, std::uint32_t push_constant_bytes) {
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, push_constant_bytes);
    vk::PipelineLayoutCreateInfo info;
    info.setSetLayouts(set);
    if (push_constant_bytes > 0) info.setPushConstantRanges(push);
    return vk::raii::PipelineLayout(context.vk(), info);
}

vk::raii::Pipeline make_pipeline(Context& context, const ComputeShader& shader, vk::PipelineLayout layout) {
    vk::ShaderModuleCreateInfo module_info;
    module_info.setCodeSize(shader.code.size_bytes()).setPCode(shader.code.data());
    const vk::raii::ShaderModule module(context.vk(), module_info);

    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t id = 0; id < shader.specialization.size(); ++id) entries.emplace_back(id, id * 4, 4);
    vk::SpecializationInfo constants;
    constants.setMapEntries(entries).setData<std::uint32_t>(shader.specialization);

    vk::ComputePipelineCreateInfo info;
    info.stage.setStage(vk::ShaderStageFlagBits::eCompute)
        .setModule(*module)
        .setPName("main")
        .setPSpecializationInfo(&constants);
    info.setLayout(layout);
    return vk::raii::Pipeline(context.vk(), nullptr, info);
}

} // namespace

ComputePipeline::ComputePipeline(Device& device, const ComputeShader& shader) {
    State state;
    state.context = device.context();
    state.name = shader.name;
    state.buffer_count = shader.buffer_count;
    state.push_constant_bytes = shader.push_constant_bytes;
    asking_for(*state.context, "making the compute pipeline '" + shader.name + "'", [&] {
        state.set_layout = make_set_layout(*state.context, shader.buffer_count);
        state.layout = make_layout(*state.context, *state.set_layout, shader.push_constant_bytes);
        state.pipeline = make_pipeline(*state.context, shader, *state.layout);
    });
    state_ = make_held(std::move(state));
}

ComputePipeline::ComputePipeline(ComputePipeline&&) noexcept = default;
ComputePipeline& ComputePipeline::operator=(ComputePipeline&&) noexcept = default;
ComputePipeline::~ComputePipeline() = default;

const std::string& ComputePipeline::name() const { return state_->name; }
std::uint32_t ComputePipeline::buffer_count() const { return state_->buffer_count; }
std::uint32_t ComputePipeline::push_constant_bytes() const { return state_->push_constant_bytes; }
VkPipeline ComputePipeline::handle() const { return *state_->pipeline; }
VkPipelineLayout ComputePipeline::layout() const { return *state_->layout; }
VkDescriptorSetLayout ComputePipeline::set_layout() const { return *state_->set_layout; }

} // namespace manylights::lab::gpu
