#pragma once
// The Vulkan handles behind a Device, for the files that record or create Vulkan objects themselves. Includes vk::raii:
// keep it out of headers.

#include "lab/gpu/device.h"
#include "lab/scene/error.h"

#include <vulkan/vulkan_raii.hpp>

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace manylights::lab::gpu {

/// The device's entry points. Deduced, since Vulkan-Hpp moved the type from one namespace to another.
using DeviceCalls = std::remove_cvref_t<decltype(*std::declval<const vk::raii::Device&>().getDispatcher())>;

struct Context {
    DeviceInfo info;
    std::atomic<std::uint64_t> validation_messages{0};
    std::string validation_layer;
    bool hung = false; ///< a submission passed its time limit: the device may still be at work

    vk::raii::Context loader;
    std::optional<vk::raii::Instance> instance;
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger;
    std::optional<vk::raii::PhysicalDevice> physical;
    std::optional<vk::raii::Device> device;
    std::optional<vk::raii::Queue> queue;
    std::uint32_t queue_family = 0;
    std::uint32_t timestamp_bits = 0;
    double timestamp_ns = 0; ///< nanoseconds per tick
    vk::PhysicalDeviceMemoryProperties memory;

    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    vk::raii::Device& vk() { return *device; }

    /// A memory type among `allowed` (bits) with all of `required`, and with `preferred` where there is one. Throws
    /// DeviceError.
    std::uint32_t memory_type(std::uint32_t allowed, vk::MemoryPropertyFlags required,
                              vk::MemoryPropertyFlags preferred) const;
};

/// Allocates memory for something; what names it in the DeviceError.
vk::raii::DeviceMemory allocate(Context& context, const vk::MemoryRequirements& needs, vk::MemoryPropertyFlags required,
                                vk::MemoryPropertyFlags preferred, const std::string& what);

/// Runs a piece of Vulkan work and turns what it throws into a DeviceError that says what was asked.
template <typename Work>
decltype(auto) asking_for(const Context& context, const std::string& what, Work&& work) {
    try {
        return std::forward<Work>(work)();
    } catch (const vk::SystemError& error) {
        throw DeviceError(what + " failed on " + context.info.name + ": " +
                          vk::to_string(static_cast<vk::Result>(error.code().value())));
    }
}

} // namespace manylights::lab::gpu
