#include "lab/gpu/prefix_sum.h"

#include "lab/gpu/device.h"
#include "lab/scene/error.h"

#include <algorithm>

namespace manylights::lab::gpu {

namespace {

constexpr std::uint32_t kBlocksCode[] =
#include "prefix_sum.comp.inc"
    ;
constexpr std::uint32_t kAddCode[] =
#include "prefix_sum_add.comp.inc"
    ;

// Of both shaders: 256 lanes with 8 words each. kMaxCount words are 2^15 blocks, within the 65,535 workgroups that
// every device allows, and three levels.
constexpr std::uint32_t kWordsPerBlock = 2048;

std::uint32_t block_count(std::uint32_t words) { return group_count(words, kWordsPerBlock); }

} // namespace

PrefixSum::PrefixSum(Device& device)
    : device_(device), blocks_pipeline_(device, {"prefix sum of blocks", kBlocksCode, 3, 4, {}}),
      add_pipeline_(device, {"prefix sum, blocks before", kAddCode, 2, 4, {}}) {}

void PrefixSum::reserve(std::uint32_t count) {
    if (count > kMaxCount)
        throw DeviceError("a prefix sum over " + std::to_string(count) + " words; the most is " +
                          std::to_string(kMaxCount));
    if (count <= reserved_) return;
    levels_.clear();
    for (std::uint32_t words = block_count(count); words > 1; words = block_count(words))
        levels_.emplace_back(device_, "sums of blocks", words * sizeof(std::uint32_t));
    reserved_ = count;
}

// Each level sums the blocks of the one before in place, until there is one block, whose sum is that of all.
void PrefixSum::record(Commands& commands, const Buffer& from, const Buffer& to, std::uint32_t count,
                       const Buffer& total) {
    if (count > reserved_)
        throw DeviceError("a prefix sum over " + std::to_string(count) + " words, and " + std::to_string(reserved_) +
                          " are reserved");
    const Buffer* source = &from;
    const Buffer* target = &to;
    std::uint32_t words = count;
    for (std::size_t level = 0;; ++level) {
        const std::uint32_t blocks = std::max(block_count(words), 1u);
        const Buffer& sums = blocks > 1 ? levels_[level] : total;
        commands.barrier();
        commands.dispatch(blocks_pipeline_, {{*source}, {*target}, {sums}}, words, {blocks, 1, 1});
        if (blocks == 1) break;
        source = target = &sums;
        words = blocks;
    }
    add_levels(commands, to, count);
    commands.barrier();
}

// From the top down: the words of a level get what lies before their block.
void PrefixSum::add_levels(Commands& commands, const Buffer& to, std::uint32_t count) const {
    std::vector<std::uint32_t> words{count};
    while (block_count(words.back()) > 1) words.push_back(block_count(words.back()));
    for (std::size_t level = words.size() - 1; level-- > 0;) {
        commands.barrier();
        commands.dispatch(add_pipeline_, {{level == 0 ? to : levels_[level - 1]}, {levels_[level]}}, words[level],
                          {block_count(words[level]), 1, 1});
    }
}

} // namespace manylights::lab::gpu
