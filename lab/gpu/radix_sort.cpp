#include "lab/gpu/radix_sort.h"

#include "lab/gpu/device.h"
#include "lab/scene/error.h"

#include <algorithm>
#include <string>

namespace manylights::lab::gpu {

namespace {

constexpr std::uint32_t kCountCode[] =
#include "radix_sort_count.comp.inc"
    ;
constexpr std::uint32_t kScatterCode[] =
#include "radix_sort_scatter.comp.inc"
    ;

// Of both shaders.
constexpr std::uint32_t kPairsPerBlock = 1024, kDigits = 16, kDigitBits = 4;

struct Push {
    std::uint32_t count, shift;
};

// Two passes for every eight bits, so that the result is where the pairs came from.
std::uint32_t pass_count(std::uint32_t key_bits) { return 2 * group_count(key_bits, 2 * kDigitBits); }

} // namespace

RadixSort::RadixSort(Device& device)
    : device_(device), prefix_sum_(device),
      count_pipeline_(device, {"radix sort, digits of blocks", kCountCode, 2, sizeof(Push), {}}),
      scatter_pipeline_(device, {"radix sort, pairs to their places", kScatterCode, 5, sizeof(Push), {}}) {}

void RadixSort::reserve(std::uint32_t count) {
    if (count > kMaxCount)
        throw DeviceError("a sort of " + std::to_string(count) + " pairs; the most is " + std::to_string(kMaxCount));
    if (count <= reserved_ && !scratch_.empty()) return;
    const std::uint32_t counts = kDigits * std::max(group_count(count, kPairsPerBlock), 1u);
    prefix_sum_.reserve(counts);
    scratch_.clear();
    const std::uint64_t bytes = std::uint64_t{count} * sizeof(std::uint32_t);
    scratch_.emplace_back(device_, "keys of a sort", bytes);
    scratch_.emplace_back(device_, "values of a sort", bytes);
    scratch_.emplace_back(device_, "digits of a sort", std::uint64_t{counts} * sizeof(std::uint32_t));
    scratch_.emplace_back(device_, "pairs of a sort", sizeof(std::uint32_t));
    reserved_ = count;
}

void RadixSort::record(Commands& commands, const Buffer& keys, const Buffer& values, std::uint32_t count,
                       std::uint32_t key_bits) {
    if (count > reserved_)
        throw DeviceError("a sort of " + std::to_string(count) + " pairs, and " + std::to_string(reserved_) +
                          " are reserved");
    if (count < 2) return commands.barrier();
    const std::uint32_t blocks = group_count(count, kPairsPerBlock);
    const Buffer& counts = scratch_[2];
    const Buffer *from_keys = &keys, *from_values = &values, *to_keys = &scratch_[0], *to_values = &scratch_[1];
    for (std::uint32_t pass = 0; pass < pass_count(key_bits); ++pass) {
        const Push push{count, pass * kDigitBits};
        commands.barrier();
        commands.dispatch(count_pipeline_, {{*from_keys}, {counts}}, push, {blocks, 1, 1});
        prefix_sum_.record(commands, counts, counts, kDigits * blocks, scratch_[3]);
        commands.dispatch(scatter_pipeline_, {{*from_keys}, {*from_values}, {counts}, {*to_keys}, {*to_values}}, push,
                          {blocks, 1, 1});
        std::swap(from_keys, to_keys);
        std::swap(from_values, to_values);
    }
    commands.barrier();
}

} // namespace manylights::lab::gpu
