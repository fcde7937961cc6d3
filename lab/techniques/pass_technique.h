#pragma once
// A technique that builds its structure on the device and shades with the common pass: one shader in three forms,
// behind whose common buffers the technique's own are bound. What such a technique writes is `build`, `structure`, the
// shader's walk and its options.

#include "lab/techniques/shading_pass.h"

#include <optional>

namespace manylights::lab {

class PassTechnique : public Technique {
  public:
    PassTechnique(gpu::Device& device, TechniqueInfo info, const PassShaders& shaders);

    const TechniqueInfo& info() const override { return info_; }
    void prepare(const Frame& frame) override;
    void rebuild(const Frame& frame) override { build(frame); }
    std::vector<PixelRecord> record(const Frame& frame) override;
    std::vector<float> shade(const Frame& frame) override;
    WaveSummary waves(const Frame& frame) override;
    std::vector<CellClass> classify(const Frame&) override { return {}; }
    /// Takes a light that affects a point out of the whole structure, by building it again.
    bool remove_one_reference(const Frame& frame) override;

  protected:
    /// Builds the frame's structure from spheres(), adds its time on the device to build_ms, and sets the counts of
    /// stats_. Buffers that hold what later passes read are filled with kPoison before they are written, unless their
    /// size is kept from the build before.
    virtual void build(const Frame& frame) = 0;
    /// What the shader's bindings from kCommonBuffers on are.
    virtual std::vector<const gpu::Buffer*> structure() const = 0;

    gpu::Device& device() { return device_; }
    /// The lights that the structure holds, as the membership stream has them: camera-relative centre and range, 0 for
    /// those that affect nothing.
    const gpu::Buffer& spheres() const { return spheres_.value(); }
    std::uint32_t light_count() const { return lights_.value().stream.light_count(); }

  private:
    gpu::Device& device_;
    TechniqueInfo info_;
    ShadingPass pass_;
    std::optional<FrameLights> lights_;
    std::optional<gpu::Buffer> spheres_;
};

} // namespace manylights::lab
