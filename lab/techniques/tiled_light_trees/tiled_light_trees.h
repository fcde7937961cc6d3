#pragma once

#include "lab/techniques/structure_technique.h"

namespace manylights::lab {

TechniqueInfo tiled_light_trees_info();
std::unique_ptr<Technique> make_tiled_light_trees(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
