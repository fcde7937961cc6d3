#pragma once

#include "lab/techniques/technique.h"

namespace manylights::lab {

TechniqueInfo light_volumes_info();
std::unique_ptr<Technique> make_light_volumes(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
