#pragma once
// The Vulkan instance, its validation layer, and the devices that it shows.

#include "lab/gpu/context.h"

#include <vector>

namespace manylights::lab::gpu {

/// Fills loader, instance, and where asked for messenger and validation_layer. False: there is no Vulkan driver at all.
/// Throws DeviceError where the validation layer is wanted and not installed.
bool make_instance(Context& context, bool validation);

struct FoundDevice {
    vk::raii::PhysicalDevice physical;
    DeviceInfo info;
};

/// The devices with Vulkan 1.3, the best first.
std::vector<FoundDevice> find_devices(const vk::raii::Instance& instance);

} // namespace manylights::lab::gpu
