#pragma once

#include "lab/techniques/technique.h"

namespace manylights::lab {

TechniqueInfo culling_2_5d_info();
std::unique_ptr<Technique> make_culling_2_5d(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
