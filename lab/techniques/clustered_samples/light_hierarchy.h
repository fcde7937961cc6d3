#pragma once
// A hierarchy of boxes over the lights in view, built on the device: lights in the order of their Morton codes, and
// levels of nodes above, where node i of a level has the children i * fan_out to i * fan_out + fan_out - 1 of the level
// below. So there are no pointers, and the number of lights says everything about its shape.

#include "lab/gpu/radix_sort.h"
#include "lab/techniques/device/device_view.h"
#include "lab/techniques/device/fitted_buffer.h"
#include "lab/techniques/device/visible_lights.h"

namespace manylights::lab {

class LightHierarchy {
  public:
    LightHierarchy(gpu::Device& device, std::uint32_t fan_out);

    /// Builds it and waits; the device's time in milliseconds. spheres: as PassTechnique::spheres.
    double build(const DeviceView& view, const gpu::Buffer& spheres, std::uint32_t light_count);

    std::uint32_t light_count() const { return visible_.count(); } ///< in view
    const gpu::Buffer& shape() const { return shape_.buffer(); }   ///< one HierarchyShape
    const gpu::Buffer& nodes() const { return nodes_.buffer(); }   ///< boxes, from the level above the lights up
    const gpu::Buffer& spheres() const { return spheres_.buffer(); }
    const gpu::Buffer& indices() const { return indices_.buffer(); } ///< of the lights whose spheres these are

  private:
    void fit(const DeviceView& view);
    void sort(gpu::Commands& commands);

    gpu::Device& device_;
    std::uint32_t fan_out_;
    VisibleLights visible_;
    gpu::RadixSort sort_;
    gpu::ComputePipeline extent_pipeline_, codes_pipeline_, leaves_pipeline_, level_pipeline_;
    FittedBuffer shape_, nodes_, spheres_, indices_, extent_, codes_, places_;
    std::vector<std::uint32_t> level_sizes_;
};

} // namespace manylights::lab
