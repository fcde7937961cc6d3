#include "lab/techniques/wave_cost.h"

#include "lab/scene/error.h"
#include "reference/oracle/light_hash.h"

#include <algorithm>
#include <stdexcept>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kSampleOneIn = 8;
constexpr std::uint64_t kAllBelow = 64; // blocks
constexpr std::uint32_t kHalfLanes = kBlockLanes / 2;

double cost_of(const WaveWork& work, const WaveWeights& weights) {
    return static_cast<double>(work.tested) + weights.node * static_cast<double>(work.nodes) +
           weights.check * static_cast<double>(work.checks) + weights.batch * static_cast<double>(work.batches);
}

void add_to(WaveWork& sum, const WaveWork& wave) {
    sum.waves += wave.waves;
    sum.tested += wave.tested;
    sum.affecting += wave.affecting;
    sum.nodes += wave.nodes;
    sum.checks += wave.checks;
    sum.batches += wave.batches;
}

double percentile_99(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const std::size_t rank = (values.size() * 99 + 99) / 100 - 1; // ceil(0.99 n), counted from 0
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(rank));
    return values[rank];
}

} // namespace

double mean_wave_cost(const WaveWork& work, const WaveWeights& weights) {
    return work.waves == 0 ? 0.0 : cost_of(work, weights) / static_cast<double>(work.waves);
}

std::vector<std::uint32_t> sampled_blocks(std::uint32_t width, std::uint32_t height) {
    const std::uint64_t blocks = ((std::uint64_t{width} + kBlockEdge - 1) / kBlockEdge) *
                                 ((std::uint64_t{height} + kBlockEdge - 1) / kBlockEdge);
    std::vector<std::uint32_t> sampled;
    for (std::uint64_t i = 0; i < blocks; ++i) {
        const auto block = static_cast<std::uint32_t>(i);
        if (blocks < kAllBelow || light_hash_a(block) % kSampleOneIn == 0) sampled.push_back(block);
    }
    return sampled;
}

void WaveUnions::add(std::uint64_t lane, std::span<const MlUint> words) {
    const auto half = static_cast<std::uint32_t>(lane / kHalfLanes) + 2u;
    if (half < half_) throw std::invalid_argument("WaveUnions: a lane of a wave that has ended");
    if (half != half_) begin(half);
    for (const MlUint word : words) touch(word);
}

WaveSummary WaveUnions::finish() {
    end_half();
    end_block();
    summary_.cost_64_p99 = percentile_99(std::move(costs_64_));
    return summary_;
}

void WaveUnions::touch(MlUint word) {
    const MlUint kind = word >> kTouchIndexBits;
    if (kind >= kTouchKinds)
        throw InputError("modelled wave cost: a light, node or reference has an index of more than 29 bits");
    const MlUint index = word & ((MlUint{1} << kTouchIndexBits) - 1);
    std::vector<std::uint32_t>& stamps = stamps_[kind];
    if (index >= stamps.size()) stamps.resize(std::max<std::size_t>(std::size_t{index} + 1, 2 * stamps.size()));
    std::uint32_t& stamp = stamps[index];
    if (stamp == half_) return;
    half_counts_[kind] += 1;
    block_counts_[kind] += stamp / 2 != half_ / 2;
    stamp = half_;
}

void WaveUnions::begin(std::uint32_t half) {
    end_half();
    if (half / 2 != half_ / 2) end_block();
    half_ = half;
}

// What a wave did, which is forgotten. All zero where no lane had a point.
WaveWork WaveUnions::take(Counts& counts) const {
    WaveWork work;
    if (counts[kTouchLane] > 0)
        work = {1,
                counts[kTouchTested] + tested_by_all_,
                counts[kTouchAffecting],
                counts[kTouchNode],
                counts[kTouchCheck],
                counts[kTouchBatch]};
    counts = {};
    return work;
}

void WaveUnions::end_half() { add_to(summary_.lanes_32, take(half_counts_)); }

void WaveUnions::end_block() {
    const WaveWork wave = take(block_counts_);
    add_to(summary_.lanes_64, wave);
    if (wave.waves > 0) costs_64_.push_back(cost_of(wave, kDefaultWeights));
}

} // namespace manylights::lab
