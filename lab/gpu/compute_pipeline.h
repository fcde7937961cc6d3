#pragma once
// A compute shader with storage buffers in set 0, bindings 0 to n - 1, and push constants.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

typedef struct VkPipeline_T* VkPipeline;
typedef struct VkPipelineLayout_T* VkPipelineLayout;
typedef struct VkDescriptorSetLayout_T* VkDescriptorSetLayout;

namespace manylights::lab::gpu {

class Device;

struct ComputeShader {
    std::string name; ///< in messages
    std::span<const std::uint32_t> code;
    std::uint32_t buffer_count = 0;            ///< bindings 0 to buffer_count - 1 of set 0
    std::uint32_t push_constant_bytes = 0;     ///< a multiple of 4, at most 128
    std::vector<std::uint32_t> specialization; ///< constant_id i has the 32 bits of element i
};

class ComputePipeline {
  public:
    ComputePipeline(Device& device, const ComputeShader& shader);
    ComputePipeline(ComputePipeline&&) noexcept;
    ComputePipeline& operator=(ComputePipeline&&) noexcept;
    ~ComputePipeline();

    const std::string& name() const;
    std::uint32_t buffer_count() const;
    std::uint32_t push_constant_bytes() const;
    VkPipeline handle() const;
    VkPipelineLayout layout() const;
    VkDescriptorSetLayout set_layout() const;

  private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace manylights::lab::gpu
