#pragma once

#include "lab/techniques/structure_technique.h"

namespace manylights::lab {

TechniqueInfo depth_windows_info();
std::unique_ptr<Technique> make_depth_windows(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
