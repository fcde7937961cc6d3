// Prefix sums on the device against sums on the host: every level of blocks, awkward sizes, in place and not.

#include "lab/gpu/device.h"
#include "lab/gpu/prefix_sum.h"
#include "lab/scene/error.h"
#include "tests/parity/validated_device.h"

#include <gtest/gtest.h>

#include <string>

namespace manylights::lab::gpu {
namespace {

constexpr std::uint32_t kPoison = 0xCDCDCDCD;
constexpr std::uint32_t kSpare = 64; // words behind the sums, which nobody may touch

// Large enough that the sums of a few wrap around.
std::vector<std::uint32_t> made_words(std::uint32_t count) {
    std::vector<std::uint32_t> words(count);
    std::uint32_t state = count;
    for (std::uint32_t& word : words) word = state = state * 1664525u + 1013904223u;
    return words;
}

struct Sums {
    std::vector<std::uint32_t> before; ///< each word
    std::uint32_t total = 0;
};

Sums sums_of(const std::vector<std::uint32_t>& words) {
    Sums sums;
    for (const std::uint32_t word : words) {
        sums.before.push_back(sums.total);
        sums.total += word;
    }
    return sums;
}

Buffer poisoned(Device& device, const char* name, std::uint32_t words) {
    Buffer buffer(device, name, std::uint64_t{words} * 4);
    buffer.fill(kPoison);
    return buffer;
}

void expect_sums(const Sums& expected, const Buffer& got, const Buffer& total) {
    const std::vector<std::uint32_t> words = got.download<std::uint32_t>();
    const std::size_t count = expected.before.size();
    ASSERT_EQ(words.size(), count + kSpare);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(words[i], expected.before[i]) << "word " << i;
    for (std::size_t i = count; i < words.size(); ++i) ASSERT_EQ(words[i], kPoison) << "word " << i;
    EXPECT_EQ(total.download<std::uint32_t>(), (std::vector<std::uint32_t>{expected.total, kPoison}));
}

class GpuPrefixSum : public testing::TestWithParam<std::uint32_t> {};

TEST_P(GpuPrefixSum, is_that_of_the_host_and_touches_nothing_behind_it) {
    Device& device = validated_device();
    const std::uint32_t count = GetParam();
    const std::vector<std::uint32_t> words = made_words(count);
    Buffer source = poisoned(device, "source", count + kSpare);
    source.upload(words);
    const Buffer target = poisoned(device, "target", count + kSpare);
    const Buffer total = poisoned(device, "total", 2);
    PrefixSum prefix_sum(device);
    prefix_sum.reserve(count);
    Commands commands(device);
    prefix_sum.record(commands, source, target, count, total);
    commands.submit_and_wait("prefix sums");
    expect_sums(sums_of(words), target, total);
    EXPECT_EQ(source.download<std::uint32_t>(count), words) << "the source was written";
    EXPECT_EQ(device.validation_messages(), 0u);
}

TEST_P(GpuPrefixSum, works_in_place_and_again_in_the_same_commands) {
    Device& device = validated_device();
    const std::uint32_t count = GetParam();
    const std::vector<std::uint32_t> words = made_words(count);
    Buffer buffer = poisoned(device, "words", count + kSpare);
    buffer.upload(words);
    const Buffer total = poisoned(device, "total", 2), second_total = poisoned(device, "second total", 2);
    PrefixSum prefix_sum(device);
    prefix_sum.reserve(count + 100000);
    Commands commands(device);
    prefix_sum.record(commands, buffer, buffer, count, total);
    prefix_sum.record(commands, buffer, buffer, count, second_total);
    commands.submit_and_wait("prefix sums");
    const Sums once = sums_of(words), twice = sums_of(once.before);
    EXPECT_EQ(total.download<std::uint32_t>(1)[0], once.total);
    expect_sums(twice, buffer, second_total);
    EXPECT_EQ(device.validation_messages(), 0u);
}

// A block has 2,048 words, so the sums of 4,194,304 words have two levels, and of one more three.
INSTANTIATE_TEST_SUITE_P(AwkwardSizes, GpuPrefixSum,
                         testing::Values(0u, 1u, 63u, 64u, 65u, 1023u, 1025u, 2047u, 2048u, 2049u, 65537u, 1000003u,
                                         4194304u, 4194305u));

std::string refusal(Device& device, std::uint32_t reserved, std::uint32_t count) {
    try {
        PrefixSum prefix_sum(device);
        prefix_sum.reserve(reserved);
        const Buffer words(device, "words", 16), total(device, "total", 4);
        Commands commands(device);
        prefix_sum.record(commands, words, words, count, total);
    } catch (const DeviceError& error) {
        return error.what();
    }
    return "";
}

TEST(GpuPrefixSumLimits, names_the_most_and_what_is_reserved) {
    Device& device = validated_device();
    EXPECT_NE(refusal(device, PrefixSum::kMaxCount + 1, 0).find("67108864"), std::string::npos);
    EXPECT_NE(refusal(device, 3, 4).find("3 are reserved"), std::string::npos);
    EXPECT_EQ(refusal(device, 4, 4), "");
}

} // namespace
} // namespace manylights::lab::gpu
