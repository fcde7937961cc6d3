#pragma once
// A vertex and a fragment shader that draw triangles, with storage buffers in set 0, bindings 0 to n - 1, and push
// constants, both for either shader; buffers of a vertex shader must be readonly. A vertex is what the shader makes of
// its number, or of attributes.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan_core.h>

namespace manylights::lab::gpu {

class Device;

struct RasterShader {
    std::string name; ///< in messages
    std::span<const std::uint32_t> vertex, fragment;
    std::uint32_t buffer_count = 0;
    std::uint32_t push_constant_bytes = 0;     ///< a multiple of 4, at most 128
    std::vector<std::uint32_t> specialization; ///< of both shaders: constant_id i has the 32 bits of element i
    std::uint32_t vertex_bytes = 0;            ///< of the attributes of a vertex
    std::vector<VkVertexInputAttributeDescription> attributes;
};

/// What the rasteriser and the attachments do; by default there is no attachment, and the fragment shader writes to its
/// buffers alone.
struct RasterState {
    VkCullModeFlags cull = VK_CULL_MODE_NONE; ///< front faces turn counter-clockwise on the image
    VkFormat color = VK_FORMAT_UNDEFINED;
    bool adds_color = false; ///< to what is there, in the order of primitives, instead of replacing it
    VkFormat depth = VK_FORMAT_UNDEFINED;
    VkCompareOp depth_passes = VK_COMPARE_OP_ALWAYS; ///< the fragment's depth, compared with the stored one
    bool writes_depth = false;
    bool clamps_depth = false; ///< to [0, 1], instead of clipping at the near and the far plane
};

class RasterPipeline {
  public:
    /// Throws DeviceError, also where the device cannot add to the colour's format.
    RasterPipeline(Device& device, const RasterShader& shader, const RasterState& state);
    RasterPipeline(RasterPipeline&&) noexcept;
    RasterPipeline& operator=(RasterPipeline&&) noexcept;
    ~RasterPipeline();

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
