#pragma once

#include "lab/techniques/technique.h"

namespace manylights::lab {

TechniqueInfo tiled_info();
std::unique_ptr<Technique> make_tiled(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
