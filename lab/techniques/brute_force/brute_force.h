#pragma once

#include "lab/techniques/technique.h"

namespace manylights::lab {

TechniqueInfo brute_force_info();
std::unique_ptr<Technique> make_brute_force(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
