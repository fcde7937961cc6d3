#pragma once
// The first pass of techniques that build on the device: which lights are in view, and what they cover there.

#include "lab/gpu/prefix_sum.h"
#include "lab/techniques/device/device_view.h"
#include "lab/techniques/device/fitted_buffer.h"

namespace manylights::lab {

/// The text of visible_light.glsl.
struct VisibleLight {
    glm::vec4 sphere; ///< in the camera's axes: offsets to the right and down, depth; culling radius
    std::uint32_t index;
    std::uint32_t columns, rows; ///< of pixels: first, and last in the upper 16 bits
    std::uint32_t unused;
};
static_assert(sizeof(VisibleLight) == 32);

class VisibleLights {
  public:
    explicit VisibleLights(gpu::Device& device);

    /// Finds them and waits; the device's time in milliseconds. spheres: as PassTechnique::spheres.
    double find(const DeviceView& view, const gpu::Buffer& spheres, std::uint32_t light_count);

    /// VisibleLight each, in the order of their indices; room for all lights.
    const gpu::Buffer& lights() const { return lights_.buffer(); }
    std::uint32_t count() const { return count_; }

  private:
    gpu::Device& device_;
    gpu::PrefixSum prefix_sum_;
    gpu::ComputePipeline mark_pipeline_, write_pipeline_;
    FittedBuffer marks_, places_, total_, lights_;
    std::uint32_t count_ = 0;
};

} // namespace manylights::lab
