// Sorts of pairs on the device, against a stable sort on the host.

#include "lab/gpu/commands.h"
#include "lab/gpu/radix_sort.h"
#include "lab/scene/error.h"
#include "reference/oracle/random.h"
#include "tests/parity/validated_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace manylights::lab::gpu {
namespace {

class RadixSortTest : public testing::Test {
  protected:
    static Device& device() { return validated_device(); }
};

struct Pairs {
    std::vector<std::uint32_t> keys, values;
    bool operator==(const Pairs&) const = default;
};

Pairs random_pairs(std::uint32_t count, std::uint32_t bits, std::uint32_t seed) {
    oracle::Random random(seed);
    Pairs pairs;
    for (std::uint32_t i = 0; i < count; ++i) {
        pairs.keys.push_back(static_cast<std::uint32_t>(random.bits() >> (64 - bits)));
        pairs.values.push_back(i);
    }
    return pairs;
}

Pairs sorted_on_host(const Pairs& pairs) {
    std::vector<std::uint32_t> order(pairs.keys.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return pairs.keys[a] < pairs.keys[b]; });
    Pairs sorted;
    for (const std::uint32_t i : order) {
        sorted.keys.push_back(pairs.keys[i]);
        sorted.values.push_back(pairs.values[i]);
    }
    return sorted;
}

Pairs sorted_on_device(Device& device, RadixSort& sort, const Pairs& pairs, std::uint32_t bits) {
    const auto count = static_cast<std::uint32_t>(pairs.keys.size());
    const Buffer keys(device, "keys", std::span<const std::uint32_t>(pairs.keys));
    const Buffer values(device, "values", std::span<const std::uint32_t>(pairs.values));
    sort.reserve(count);
    Commands commands(device);
    sort.record(commands, keys, values, count, bits);
    commands.submit_and_wait("sort");
    return {keys.download<std::uint32_t>(), values.download<std::uint32_t>()};
}

TEST_F(RadixSortTest, is_a_stable_sort_for_every_count_and_number_of_bits) {
    RadixSort sort(device());
    for (const std::uint32_t count : {0u, 1u, 2u, 3u, 4u, 5u, 255u, 1023u, 1024u, 1025u, 2049u, 65537u, 300001u}) {
        for (const std::uint32_t bits : {1u, 4u, 8u, 9u, 20u, 32u}) {
            const Pairs pairs = random_pairs(count, bits, count + bits);
            ASSERT_EQ(sorted_on_device(device(), sort, pairs, bits), sorted_on_host(pairs))
                << count << " pairs of " << bits << " bits";
        }
    }
}

TEST_F(RadixSortTest, keeps_equal_keys_in_order_and_ends_with_the_largest) {
    RadixSort sort(device());
    Pairs pairs = random_pairs(5000, 1, 7);
    std::fill(pairs.keys.begin(), pairs.keys.end(), 0xFFFFFFFFu);
    EXPECT_EQ(sorted_on_device(device(), sort, pairs, 32), pairs);
    pairs.keys[0] = 0;
    pairs.keys[4999] = 0x7FFFFFFF;
    EXPECT_EQ(sorted_on_device(device(), sort, pairs, 32), sorted_on_host(pairs));
}

TEST_F(RadixSortTest, refuses_what_it_has_no_room_for) {
    RadixSort sort(device());
    sort.reserve(10);
    const Buffer words(device(), "words", 11 * sizeof(std::uint32_t));
    Commands commands(device());
    EXPECT_THROW(sort.record(commands, words, words, 11, 32), DeviceError);
    EXPECT_THROW(sort.reserve(RadixSort::kMaxCount + 1), DeviceError);
}

} // namespace
} // namespace manylights::lab::gpu
