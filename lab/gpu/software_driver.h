#pragma once
// Finding the software driver that scripts/setup provides.

#include <string>

namespace manylights::lab::gpu {

/// The driver manifest under the project's build folder, found from where the program lies or from where it was built;
/// empty where there is none.
std::string find_software_driver();

/// Lets the Vulkan loader see that driver beside the system's own. Leaves everything alone where the user has chosen
/// drivers by VK_DRIVER_FILES or VK_ICD_FILENAMES. Once per process, before the first instance.
void offer_software_driver();

} // namespace manylights::lab::gpu
