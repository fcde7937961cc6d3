#pragma once

#include "lab/techniques/technique.h"

namespace manylights::lab {

TechniqueInfo octree_info();
std::unique_ptr<Technique> make_octree(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
