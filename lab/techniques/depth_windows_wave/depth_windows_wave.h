#pragma once

#include "lab/techniques/structure_technique.h"

namespace manylights::lab {

TechniqueInfo depth_windows_wave_info();
std::unique_ptr<Technique> make_depth_windows_wave(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
