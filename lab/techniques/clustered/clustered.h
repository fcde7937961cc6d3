#pragma once

#include "lab/techniques/structure_technique.h"

namespace manylights::lab {

TechniqueInfo clustered_info();
std::unique_ptr<Technique> make_clustered(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
