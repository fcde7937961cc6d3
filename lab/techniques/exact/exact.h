#pragma once

#include "lab/techniques/technique.h"

namespace manylights::lab {

TechniqueInfo exact_info();
std::unique_ptr<Technique> make_exact(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
