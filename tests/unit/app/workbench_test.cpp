#include "lab/app/workbench.h"

#include "lab/scene/error.h"

#include <gtest/gtest.h>

namespace manylights::lab::app {
namespace {

TEST(CheckMemory, what_cannot_fit_is_refused_with_both_sizes) {
    Selectors selectors;
    selectors.width = 4096;
    selectors.height = 4096;
    selectors.lights.count = 1u << 24;
    gpu::DeviceInfo device;
    device.name = "card";
    // 2^24 pixels of 112 bytes and 2^24 lights of 32 bytes are 2.25 GiB.
    device.memory_bytes = 9ull << 28;
    EXPECT_NO_THROW(check_memory(selectors, Scene{}, device));
    device.memory_bytes -= 1;
    try {
        check_memory(selectors, Scene{}, device);
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "--size 4096x4096 with 16777216 lights: needs at least 2.2 GiB, card has 2.2 GiB");
    }
}

} // namespace
} // namespace manylights::lab::app
