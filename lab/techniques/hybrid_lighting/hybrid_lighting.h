#pragma once

#include "lab/techniques/technique.h"

namespace manylights::lab {

TechniqueInfo hybrid_lighting_info();
std::unique_ptr<Technique> make_hybrid_lighting(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
