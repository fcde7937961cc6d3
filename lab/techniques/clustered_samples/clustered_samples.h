#pragma once

#include "lab/techniques/technique.h"

namespace manylights::lab {

TechniqueInfo clustered_samples_info();
std::unique_ptr<Technique> make_clustered_samples(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
