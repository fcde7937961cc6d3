#pragma once
// The structures of Tiled Light Trees built on the device: the paper's own pipeline, whose move to the GPU it names as
// future work.

#include "lab/techniques/structure_build.h"

namespace manylights::lab {

/// name: the technique's, in messages. options: with on_device.
std::unique_ptr<StructureBuild> make_device_build(gpu::Device& device, const std::string& name,
                                                  const StructureOptions& options);

} // namespace manylights::lab
