#pragma once

#include "lab/techniques/technique.h"

namespace manylights::lab {

TechniqueInfo light_linked_list_info();
std::unique_ptr<Technique> make_light_linked_list(gpu::Device& device, const OptionValues& options);

} // namespace manylights::lab
