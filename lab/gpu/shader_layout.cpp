#include "lab/gpu/shader_layout.h"

namespace manylights::lab::gpu {

namespace {

vk::raii::DescriptorSetLayout make_set_layout(Context& context, std::uint32_t buffer_count,
                                              vk::ShaderStageFlags stages) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t binding = 0; binding < buffer_count; ++binding)
        bindings.emplace_back(binding, vk::DescriptorType::eStorageBuffer, 1u, stages);
    vk::DescriptorSetLayoutCreateInfo info;
    info.setBindings(bindings);
    return vk::raii::DescriptorSetLayout(context.vk(), info);
}

vk::raii::PipelineLayout make_pipeline_layout(Context& context, vk::DescriptorSetLayout set,
                                              std::uint32_t push_constant_bytes, vk::ShaderStageFlags stages) {
    const vk::PushConstantRange push(stages, 0, push_constant_bytes);
    vk::PipelineLayoutCreateInfo info;
    info.setSetLayouts(set);
    if (push_constant_bytes > 0) info.setPushConstantRanges(push);
    return vk::raii::PipelineLayout(context.vk(), info);
}

} // namespace

ShaderLayout make_shader_layout(Context& context, std::uint32_t buffer_count, std::uint32_t push_constant_bytes,
                                vk::ShaderStageFlags stages) {
    ShaderLayout layout;
    layout.buffer_count = buffer_count;
    layout.push_constant_bytes = push_constant_bytes;
    layout.set = make_set_layout(context, buffer_count, stages);
    layout.pipeline = make_pipeline_layout(context, *layout.set, push_constant_bytes, stages);
    return layout;
}

vk::raii::ShaderModule make_shader_module(Context& context, std::span<const std::uint32_t> code) {
    vk::ShaderModuleCreateInfo info;
    info.setCodeSize(code.size_bytes()).setPCode(code.data());
    return vk::raii::ShaderModule(context.vk(), info);
}

ShaderConstants::ShaderConstants(std::span<const std::uint32_t> values) {
    for (std::uint32_t id = 0; id < values.size(); ++id) entries_.emplace_back(id, id * 4, 4);
    info_.setMapEntries(entries_).setDataSize(values.size_bytes()).setPData(values.data());
}

} // namespace manylights::lab::gpu
