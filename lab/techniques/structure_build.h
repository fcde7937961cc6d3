#pragma once
// Who makes a structure of the library's format ready on the device: a producer on the CPU, or passes on the device.

#include "lab/techniques/producer.h"
#include "lab/techniques/shading_pass.h"
#include "lab/techniques/structure_buffers.h"

namespace manylights::lab {

/// A structure as the passes read it.
struct BuiltStructure {
    StructureBindings buffers{};
    std::uint64_t references = 0;

    std::uint64_t bytes() const;
};

class StructureBuild {
  public:
    virtual ~StructureBuild() = default;
    /// Its buffers are the builder's, and stay until the next build.
    virtual BuiltStructure build(const Frame& frame, const FrameLights& lights) = 0;

    // Of the last build:
    std::uint64_t visible_lights() const { return visible_lights_; }
    double milliseconds() const { return milliseconds_; }
    const std::vector<StageTime>& stages() const { return stages_; } ///< in the order of the work

  protected:
    std::uint64_t visible_lights_ = 0;
    double milliseconds_ = 0.0;
    std::vector<StageTime> stages_;
};

/// One of the two producers.
std::unique_ptr<StructureBuild> make_host_build(gpu::Device& device, const StructureOptions& options);

} // namespace manylights::lab
