#pragma once
// Lights in view by their depth: what techniques that sort on the device have in common.

#include "lab/gpu/radix_sort.h"
#include "lab/techniques/device/visible_lights.h"

namespace manylights::lab {

class DepthOrder {
  public:
    /// by_near_end: of the sphere, instead of its centre.
    DepthOrder(gpu::Device& device, bool by_near_end);

    /// Room for so many lights. No commands that use it may be running, or be recorded and not yet done.
    void reserve(std::uint32_t lights);
    /// Records the order of the lights, stable: ascending by depth, or without sorting that of their indices. A barrier
    /// is behind it.
    void record(gpu::Commands& commands, const VisibleLights& lights, bool sorts = true);

    /// By rank: which of the lights in view.
    const gpu::Buffer& order() const { return order_.buffer(); }
    /// By rank: a whole number that ascends with the light's depth. Where nothing was sorted; else undefined.
    const gpu::Buffer& unsorted_keys() const { return keys_.buffer(); }

  private:
    gpu::RadixSort sort_;
    gpu::ComputePipeline keys_pipeline_;
    FittedBuffer keys_, order_;
};

} // namespace manylights::lab
