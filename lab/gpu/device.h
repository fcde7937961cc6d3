#pragma once
// The Vulkan device that the lab computes and draws on. Needs Vulkan 1.3; a real GPU is preferred, else Mesa's software
// driver (25 or newer), which scripts/setup puts under <build>/lavapipe and which is found there without any setting.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace manylights::lab::gpu {

struct DeviceOptions {
    std::string selector;    ///< index in list_devices(), or part of the name (case ignored); empty: the best one
    bool validation = false; ///< core and synchronization validation; DeviceError where the layer is not installed
};

struct DeviceInfo {
    std::string name;    ///< e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver;  ///< e.g. "llvmpipe"
    std::string version; ///< of the driver, in its own words, e.g. "Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6)"
    bool is_software = false;
    std::uint64_t max_storage_buffer_range = 0; ///< bytes of one binding
    std::uint64_t max_allocation = 0;           ///< bytes of one memory allocation
    std::uint64_t memory_bytes = 0;             ///< of the device's largest heap
    std::uint32_t max_workgroups[3]{};          ///< per dispatch
    std::uint32_t max_image_size = 0;
    std::uint32_t subgroup_size = 0;
    bool has_wave_operations = false; ///< vote, ballot and reductions over a subgroup, in compute shaders
};

/// All devices with Vulkan 1.3, the best first: real GPUs before software, newer software drivers before older ones.
/// Empty where there is none. Nothing is probed here.
std::vector<DeviceInfo> list_devices();

struct Context; // lab/gpu/context.h: the Vulkan handles, for the parts of the lab that record commands of their own

/// One logical device with one queue. Throws DeviceError in one line: no device, no match for the selector, a missing
/// feature, or a driver that computes wrong (it fails the behaviour probe).
class Device {
  public:
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const;
    bool validation_active() const;              ///< the layer was really loaded
    std::uint64_t validation_messages() const;   ///< warnings and errors so far
    const std::string& validation_layer() const; ///< name and version of the layer; empty where not active
    const std::shared_ptr<Context>& context() const { return context_; }

  private:
    std::shared_ptr<Context> context_;
};

} // namespace manylights::lab::gpu
