#pragma once
// A technique that builds what it needs on the device, from the frame's lights.

#include "lab/techniques/shading_pass.h"

#include <optional>

namespace manylights::lab {

class DeviceTechnique : public Technique {
  public:
    DeviceTechnique(gpu::Device& device, TechniqueInfo info) : device_(device), info_(std::move(info)) {}

    const TechniqueInfo& info() const override { return info_; }
    void prepare(const Frame& frame) override;
    void rebuild(const Frame& frame) override { build(frame); }
    std::vector<CellClass> classify(const Frame&) override { return {}; }
    /// Takes a light that affects a point out of the whole structure, by building it again.
    bool remove_one_reference(const Frame& frame) override;

  protected:
    /// Builds the frame's structure from spheres(), adds its time on the device to build_ms, and sets the counts of
    /// stats_. Buffers that hold what later passes read are filled with kPoison before they are written, unless their
    /// size is kept from the build before.
    virtual void build(const Frame& frame) = 0;

    gpu::Device& device() const { return device_; }
    const FrameLights& lights() const { return lights_.value(); }
    /// The lights that the structure holds, as the membership stream has them: camera-relative centre and range, 0 for
    /// those that affect nothing.
    const gpu::Buffer& spheres() const { return spheres_.value(); }
    std::uint32_t light_count() const { return lights().stream.light_count(); }

  private:
    gpu::Device& device_;
    TechniqueInfo info_;
    std::optional<FrameLights> lights_;
    std::optional<gpu::Buffer> spheres_;
};

} // namespace manylights::lab
