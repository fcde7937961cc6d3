#pragma once

#include "lab/techniques/technique.h"

namespace manylights::lab {

TechniqueInfo z_bins_info();
/// Throws DeviceError where loop=wave needs what the device lacks.
std::unique_ptr<Technique> make_z_bins(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
