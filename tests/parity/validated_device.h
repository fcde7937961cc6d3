#pragma once
// The device of a test program, under core and synchronization validation: opened by the first test that asks, closed
// after the last one. Not by a static object's destructor, which would run when the driver may have ended already.

#include "lab/gpu/device.h"

#include <gtest/gtest.h>

#include <memory>

namespace manylights::lab {

class DeviceEnvironment : public testing::Environment {
  public:
    static gpu::Device& device() {
        if (!device_) device_ = std::make_unique<gpu::Device>(gpu::DeviceOptions{"", true});
        return *device_;
    }

    void TearDown() override { device_.reset(); }

  private:
    static inline std::unique_ptr<gpu::Device> device_;
};

inline testing::Environment* const kDeviceEnvironment = testing::AddGlobalTestEnvironment(new DeviceEnvironment);

/// Throws DeviceError where there is no device.
inline gpu::Device& validated_device() { return DeviceEnvironment::device(); }

} // namespace manylights::lab
