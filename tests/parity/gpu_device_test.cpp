// The device: opens with validation, refuses drivers that compute wrong, computes, and gives up in one line.

#include "lab/gpu/commands.h"
#include "lab/gpu/device.h"
#include "lab/scene/error.h"
#include "tests/parity/validated_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string>

namespace manylights::lab::gpu {
namespace {

constexpr std::uint32_t kScaleCode[] =
#include "gpu_scale.comp.inc"
    ;
constexpr std::uint32_t kSpinCode[] =
#include "gpu_spin.comp.inc"
    ;

// What the command does with a device that cannot be opened, or gives up.
[[noreturn]] void exit_with(const std::string& message) {
    std::fprintf(stderr, "<%s>\n", message.c_str());
    std::exit(3);
}

[[noreturn]] void open_with_drivers(const std::string& manifests) {
    unsetenv("VK_ICD_FILENAMES");
    setenv("VK_DRIVER_FILES", manifests.c_str(), 1);
    try {
        const Device device;
        std::fprintf(stderr, "<opened %s>\n", device.info().version.c_str());
        std::exit(0);
    } catch (const DeviceError& error) {
        exit_with(error.what());
    }
}

std::string system_software_manifest() {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/usr/share/vulkan/icd.d", error))
        if (entry.path().filename().string().starts_with("lvp_icd")) return entry.path().string();
    return {};
}

// The faults of the old versions are known; whether newer ones are refused is for the probe alone to say.
bool is_known_faulty(const DeviceInfo& info) { return info.version.find("Mesa 22.") != std::string::npos; }

TEST(GpuDevice, opens_with_the_validation_layer_loaded) {
    Device& device = validated_device();
    std::printf("device: %s, %s %s; validation layer: %s, core and synchronization\n", device.info().name.c_str(),
                device.info().driver.c_str(), device.info().version.c_str(), device.validation_layer().c_str());
    EXPECT_TRUE(device.validation_active());
    EXPECT_FALSE(device.validation_layer().empty());
    EXPECT_GE(device.info().max_storage_buffer_range, std::uint64_t(1) << 27);
}

TEST(GpuDevice, lists_the_best_device_first_and_opens_it_by_index_and_name) {
    const std::vector<DeviceInfo> infos = list_devices();
    ASSERT_FALSE(infos.empty());
    EXPECT_EQ(validated_device().info().name, infos[0].name);
    EXPECT_EQ(validated_device().info().version, infos[0].version);
    EXPECT_EQ(Device(DeviceOptions{"0", false}).info().version, infos[0].version);
    EXPECT_EQ(Device(DeviceOptions{infos[0].name.substr(0, 4), false}).info().version, infos[0].version);
}

TEST(GpuDevice, names_the_choices_when_the_selector_matches_none) {
    for (const char* selector : {"no such device", "99", "-1"}) {
        try {
            const Device device(DeviceOptions{selector, false});
            FAIL() << selector;
        } catch (const DeviceError& error) {
            EXPECT_NE(std::string(error.what()).find(selector), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(list_devices()[0].name), std::string::npos) << error.what();
        }
    }
}

TEST(GpuDeviceDeathTest, says_in_one_line_that_there_is_no_device) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(open_with_drivers("/nonexistent/icd.json"), testing::ExitedWithCode(3),
                "<no Vulkan 1.3 device: run scripts/setup[^\n]*>");
}

TEST(GpuDeviceDeathTest, refuses_a_driver_that_computes_wrong) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const std::string manifest = system_software_manifest();
    if (manifest.empty()) GTEST_SKIP() << "the system has no software driver of its own";
    const std::vector<DeviceInfo> infos = list_devices();
    if (std::none_of(infos.begin(), infos.end(), is_known_faulty))
        GTEST_SKIP() << "the system's software driver is not one of the faulty ones";
    EXPECT_EXIT(open_with_drivers(manifest), testing::ExitedWithCode(3),
                "<the device llvmpipe [^\n]* computes wrong: its loops [^\n]* and its memory barriers [^\n]*run "
                "scripts/setup[^\n]*>");
}

TEST(GpuDeviceDeathTest, gives_up_on_work_that_does_not_end) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto spin = [] {
        try {
            Device device;
            const ComputePipeline pipeline(device, {"spin", kSpinCode, 1, 4, {}});
            const Buffer result(device, "result", 4);
            Commands commands(device);
            commands.dispatch(pipeline, {{result}}, 0xFFFFFFFFu, {1, 1, 1});
            commands.submit_and_wait("spinning", 0.05);
            std::exit(0);
        } catch (const DeviceError& error) {
            exit_with(error.what());
        }
    };
    EXPECT_EXIT(spin(), testing::ExitedWithCode(3), "<the device [^\n]* did not finish spinning within 0.05[^\n]* s>");
}

class GpuCompute : public testing::TestWithParam<std::uint32_t> {};

TEST_P(GpuCompute, scales_a_buffer_and_touches_nothing_behind_it) {
    Device& device = validated_device();
    const std::uint32_t count = GetParam();
    const ComputePipeline pipeline(device, {"scale", kScaleCode, 2, 4, {3, 7}});
    std::vector<std::uint32_t> values(count);
    std::iota(values.begin(), values.end(), 1u);
    const Buffer source(device, "source", std::span<const std::uint32_t>(values));
    const Buffer target(device, "target", (count + 64) * 4);
    Commands commands(device);
    commands.fill(target, 0xABCDEF01u);
    commands.barrier();
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(pipeline, {{source}, {target}}, count, {group_count(count, 64), 1, 1});
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait();
    const std::vector<std::uint32_t> result = target.download<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(result[i], values[i] * 3 + 7) << i;
    for (std::uint32_t i = count; i < count + 64; ++i) ASSERT_EQ(result[i], 0xABCDEF01u) << i;
    EXPECT_GE(commands.milliseconds(start, end), 0.0);
    EXPECT_LT(commands.milliseconds(start, end), 60000.0);
    EXPECT_EQ(device.validation_messages(), 0u);
}

INSTANTIATE_TEST_SUITE_P(AwkwardSizes, GpuCompute, testing::Values(0u, 1u, 63u, 64u, 65u, 65537u));

TEST(GpuBuffer, keeps_bytes_in_every_kind_of_memory) {
    Device& device = validated_device();
    std::vector<std::uint32_t> values(1001);
    std::iota(values.begin(), values.end(), 77u);
    for (const Memory memory : {Memory::device, Memory::upload, Memory::readback}) {
        Buffer buffer(device, "kinds", 1002 * 4, memory);
        buffer.fill(0x01020304u);
        buffer.upload(values, 4);
        EXPECT_EQ(buffer.download<std::uint32_t>(1001, 4), values);
        EXPECT_EQ(buffer.download<std::uint32_t>(1)[0], 0x01020304u);
        EXPECT_EQ(buffer.mapped() == nullptr, memory == Memory::device);
    }
    EXPECT_EQ(device.validation_messages(), 0u);
}

TEST(GpuBuffer, names_the_size_and_the_limit_when_it_is_too_large) {
    Device& device = validated_device();
    const std::uint64_t limit = device.info().max_storage_buffer_range;
    try {
        const Buffer buffer(device, "enormous", limit + 1);
        FAIL();
    } catch (const DeviceError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("'enormous'"), std::string::npos) << text;
        EXPECT_NE(text.find(std::to_string(limit + 1)), std::string::npos) << text;
        EXPECT_NE(text.find(std::to_string(limit)), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
}

TEST(GpuBuffer, refuses_ranges_outside_itself) {
    Device& device = validated_device();
    Buffer buffer(device, "small", 8);
    EXPECT_THROW(buffer.download<std::uint32_t>(3), DeviceError);
    EXPECT_THROW(buffer.download<std::uint32_t>(1, 5), DeviceError);
    EXPECT_THROW(buffer.upload(std::vector<std::uint32_t>{1}, ~std::uint64_t(0)), DeviceError);
}

TEST(GpuValidation, reports_a_missing_barrier) {
    Device device(DeviceOptions{"", true});
    const ComputePipeline pipeline(device, {"scale", kScaleCode, 2, 4, {1, 1}});
    const Buffer a(device, "a", 256), b(device, "b", 256);
    Commands commands(device);
    commands.dispatch(pipeline, {{a}, {b}}, 64u, {1, 1, 1});
    commands.dispatch(pipeline, {{b}, {a}}, 64u, {1, 1, 1});
    commands.submit_and_wait();
    EXPECT_GT(device.validation_messages(), 0u);
}

} // namespace
} // namespace manylights::lab::gpu
