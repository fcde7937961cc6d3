#pragma once
// What pipelines of all kinds have in common: storage buffers in set 0, push constants, shader code and its constants.
// Includes vk::raii: keep it out of headers.

#include "lab/gpu/context.h"

#include <span>
#include <vector>

namespace manylights::lab::gpu {

struct ShaderLayout {
    std::uint32_t buffer_count = 0; ///< bindings 0 to buffer_count - 1 of set 0
    std::uint32_t push_constant_bytes = 0;
    vk::raii::DescriptorSetLayout set{nullptr};
    vk::raii::PipelineLayout pipeline{nullptr};
};

/// stages: those that see the buffers and the constants.
ShaderLayout make_shader_layout(Context& context, std::uint32_t buffer_count, std::uint32_t push_constant_bytes,
                                vk::ShaderStageFlags stages);

vk::raii::ShaderModule make_shader_module(Context& context, std::span<const std::uint32_t> code);

/// Specialization constants of 32 bits by their number. Must outlive the making of the pipeline.
class ShaderConstants {
  public:
    explicit ShaderConstants(std::span<const std::uint32_t> values);
    ShaderConstants(const ShaderConstants&) = delete;
    ShaderConstants& operator=(const ShaderConstants&) = delete;

    const vk::SpecializationInfo* info() const { return &info_; }

  private:
    std::vector<vk::SpecializationMapEntry> entries_;
    vk::SpecializationInfo info_;
};

} // namespace manylights::lab::gpu
