#pragma once
// What a wave does for its pixels, from what its lanes touched: unions over the lanes, for waves of 64 lanes (blocks of
// 8 x 8 pixels) and of 32 lanes (their upper and lower halves). docs/measuring.md has the definitions.

#include "lab/techniques/touch_word.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace manylights::lab {

/// Sums over the sampled waves with at least one shaded lane; within a wave, what several lanes touch counts once.
struct WaveWork {
    std::uint64_t waves = 0;
    std::uint64_t tested = 0;    ///< lights
    std::uint64_t affecting = 0; ///< lights that affect the point of any lane: the exact union
    std::uint64_t nodes = 0;     ///< of 16 bytes; a wide node of 32 bytes is two
    std::uint64_t checks = 0;    ///< references compared with a point before their light is tested
    std::uint64_t batches = 0;   ///< of candidates that the wave culls together

    bool operator==(const WaveWork&) const = default;
};

/// The cost of each in tests of a light.
struct WaveWeights {
    double node, check, batch;
};
inline constexpr WaveWeights kLightWeights{0.25, 0.125, 3.0};
inline constexpr WaveWeights kDefaultWeights{0.5, 0.25, 3.0};
inline constexpr WaveWeights kHeavyWeights{1.0, 0.5, 3.0};

/// 0 where no wave was shaded.
double mean_wave_cost(const WaveWork& work, const WaveWeights& weights);

struct WaveSummary {
    WaveWork lanes_64, lanes_32;
    double cost_64_p99 = 0; ///< nearest rank, default weights: what at least 99 % of the waves stay within

    bool operator==(const WaveSummary&) const = default;
};

constexpr std::uint32_t kBlockEdge = 8; ///< pixels
constexpr std::uint32_t kBlockLanes = kBlockEdge * kBlockEdge;

/// The blocks whose waves are looked at, by their number row by row, ascending: one in eight by a hash of the number,
/// all where the image has fewer than 64. Blocks at the image's edges may have lanes outside.
std::vector<std::uint32_t> sampled_blocks(std::uint32_t width, std::uint32_t height);

/// Makes the unions of a log. Lanes are numbered through all sampled blocks, 64 each, row by row within a block.
class WaveUnions {
  public:
    /// tested_by_all: lights that every shaded lane tests and that are not in the log.
    explicit WaveUnions(std::uint64_t tested_by_all = 0) : tested_by_all_(tested_by_all) {}

    /// Lanes come in ascending order; one may come in several pieces. Throws InputError for an index that did not fit
    /// into its word, std::invalid_argument for a lane of an earlier wave.
    void add(std::uint64_t lane, std::span<const MlUint> words);
    WaveSummary finish();

  private:
    using Counts = std::array<std::uint64_t, kTouchKinds>; ///< of one wave, by kind

    void touch(MlUint word);
    void begin(std::uint32_t half);
    WaveWork take(Counts& counts) const;
    void end_half();
    void end_block();

    std::uint64_t tested_by_all_;
    /// By kind and index: the last wave of 32 lanes that touched it, as half_ has it; 0 is none.
    std::array<std::vector<std::uint32_t>, kTouchKinds> stamps_;
    std::uint32_t half_ = 0; ///< the present wave of 32 lanes: 2 + its number, so that half_ / 2 is the block's own
    Counts half_counts_{}, block_counts_{};
    WaveSummary summary_;
    std::vector<double> costs_64_;
};

} // namespace manylights::lab
