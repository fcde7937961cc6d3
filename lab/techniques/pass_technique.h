#pragma once
// A technique that builds its structure on the device and shades with the common pass: one shader in three forms,
// behind whose common buffers the technique's own are bound. What such a technique writes is `build`, `structure`, the
// shader's walk and its options.

#include "lab/techniques/device_technique.h"

namespace manylights::lab {

class PassTechnique : public DeviceTechnique {
  public:
    PassTechnique(gpu::Device& device, TechniqueInfo info, const PassShaders& shaders);

    std::vector<PixelRecord> record(const Frame& frame) override;
    std::vector<float> shade(const Frame& frame) override;
    WaveSummary waves(const Frame& frame) override;

  protected:
    /// What the shader's bindings from kCommonBuffers on are.
    virtual std::vector<const gpu::Buffer*> structure() const = 0;

  private:
    ShadingPass pass_;
};

} // namespace manylights::lab
