// Waves' figures from what their lanes touched, without any device.

#include "lab/techniques/wave_cost.h"

#include "lab/scene/error.h"
#include "reference/oracle/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace manylights::lab {
namespace {

constexpr MlUint kShaded = kTouchLane << kTouchIndexBits;

MlUint light(MlUint index) { return touch_word(kTouchTested, index); }

void add(WaveUnions& unions, std::uint64_t lane, std::vector<MlUint> words) { unions.add(lane, words); }

using Log = std::vector<std::vector<MlUint>>; ///< per lane

// A lane of four is sky; the others touch things of every kind, many of them in common.
Log random_log(std::size_t lanes, oracle::Random& random) {
    Log log(lanes);
    for (std::vector<MlUint>& words : log) {
        if (random.chance(0.25)) continue;
        words.push_back(kShaded);
        const std::uint32_t count = random.below(30);
        for (std::uint32_t i = 0; i < count; ++i)
            words.push_back(touch_word(kTouchTested + random.below(5), random.below(random.chance(0.1) ? 90000 : 40)));
    }
    return log;
}

// The definition, in the plainest form.
WaveWork plain_unions(const Log& log, std::size_t wave_lanes) {
    std::map<std::size_t, std::set<MlUint>> waves;
    for (std::size_t lane = 0; lane < log.size(); ++lane)
        waves[lane / wave_lanes].insert(log[lane].begin(), log[lane].end());
    WaveWork work;
    for (const auto& [wave, words] : waves) {
        const auto count = [&words](MlUint kind) {
            return static_cast<std::uint64_t>(
                std::ranges::count_if(words, [kind](MlUint word) { return word >> kTouchIndexBits == kind; }));
        };
        work.waves += count(kTouchLane);
        work.tested += count(kTouchTested);
        work.affecting += count(kTouchAffecting);
        work.nodes += count(kTouchNode);
        work.checks += count(kTouchCheck);
        work.batches += count(kTouchBatch);
    }
    return work;
}

} // namespace

TEST(WaveUnions, what_several_lanes_touch_counts_once_per_wave) {
    WaveUnions unions;
    add(unions, 0, {kShaded, light(7), light(8), light(7)});
    add(unions, 31, {kShaded, light(8), touch_word(kTouchNode, 8), touch_word(kTouchNode, 9)});
    add(unions, 32, {kShaded, light(8), touch_word(kTouchAffecting, 8)});
    add(unions, 64, {kShaded, light(8), touch_word(kTouchCheck, 3), touch_word(kTouchBatch, 0)});
    const WaveSummary summary = unions.finish();
    EXPECT_EQ(summary.lanes_32, (WaveWork{3, 4, 1, 2, 1, 1}));
    EXPECT_EQ(summary.lanes_64, (WaveWork{2, 3, 1, 2, 1, 1}));
}

TEST(WaveUnions, are_those_of_plain_sets) {
    oracle::Random random(5);
    for (const std::size_t lanes : {64u, 640u, 6400u}) {
        const Log log = random_log(lanes, random);
        WaveUnions unions;
        for (std::size_t lane = 0; lane < log.size(); ++lane) unions.add(lane, log[lane]);
        const WaveSummary summary = unions.finish();
        EXPECT_EQ(summary.lanes_64, plain_unions(log, 64)) << lanes;
        EXPECT_EQ(summary.lanes_32, plain_unions(log, 32)) << lanes;
    }
}

TEST(WaveUnions, a_lane_may_come_in_pieces) {
    WaveUnions whole, pieces;
    add(whole, 5, {kShaded, light(1), light(2), light(3)});
    add(pieces, 5, {kShaded, light(1)});
    add(pieces, 5, {light(2), light(3)});
    add(pieces, 5, {});
    EXPECT_EQ(whole.finish(), pieces.finish());
}

TEST(WaveUnions, waves_of_sky_do_not_count) {
    WaveUnions unions(1000);
    add(unions, 3, {});
    add(unions, 70, {kShaded}); // the upper half alone
    add(unions, 128, {});
    add(unions, 200, {kShaded, light(1)}); // the upper half again
    add(unions, 250, {kShaded});
    const WaveSummary summary = unions.finish();
    EXPECT_EQ(summary.lanes_64, (WaveWork{2, 2001, 0, 0, 0, 0}));
    EXPECT_EQ(summary.lanes_32, (WaveWork{3, 3001, 0, 0, 0, 0}));
    EXPECT_EQ(WaveUnions(1000).finish(), WaveSummary{});
}

TEST(WaveUnions, lanes_of_a_wave_that_has_ended_are_refused) {
    WaveUnions unions;
    add(unions, 40, {kShaded});
    EXPECT_THROW(add(unions, 31, {kShaded}), std::invalid_argument);
}

TEST(WaveUnions, an_index_of_more_bits_than_a_word_has_is_refused) {
    EXPECT_EQ(touch_word(kTouchBatch, 0x1FFFFFFF), 0xBFFFFFFFu);
    EXPECT_EQ(touch_word(kTouchNode, 0x20000000), kTouchTooLarge);
    WaveUnions unions;
    try {
        add(unions, 0, {kShaded, touch_word(kTouchNode, 0x20000000)});
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("29 bits"), std::string::npos);
    }
}

TEST(WaveCost, weighs_what_a_wave_did) {
    const WaveWork work{4, 40, 17, 12, 8, 3}; // 10 tests, 3 nodes, 2 checks, 3/4 batches per wave
    EXPECT_EQ(mean_wave_cost(work, kDefaultWeights), 10 + 1.5 + 0.5 + 2.25);
    EXPECT_EQ(mean_wave_cost(work, kLightWeights), 10 + 0.75 + 0.25 + 2.25);
    EXPECT_EQ(mean_wave_cost(work, kHeavyWeights), 10 + 3.0 + 1.0 + 2.25);
    EXPECT_EQ(mean_wave_cost(WaveWork{}, kDefaultWeights), 0.0);
}

TEST(WaveCost, percentile_is_the_nearest_rank_of_the_waves_of_64) {
    for (const std::uint64_t waves : {1u, 99u, 100u, 101u, 250u}) {
        WaveUnions unions;
        for (std::uint64_t wave = 0; wave < waves; ++wave) {
            std::vector<MlUint> words{kShaded};
            for (MlUint node = 0; node < waves - wave; ++node) words.push_back(touch_word(kTouchNode, node));
            unions.add(64 * wave, words);
        }
        const std::uint64_t rank = (99 * waves + 99) / 100;
        EXPECT_EQ(unions.finish().cost_64_p99, 0.5 * static_cast<double>(rank)) << waves;
    }
}

TEST(SampledBlocks, are_all_of_a_small_image) {
    EXPECT_EQ(sampled_blocks(1, 1), (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(sampled_blocks(9, 17), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(sampled_blocks(56, 72).size(), 63u);
}

TEST(SampledBlocks, are_one_in_eight_of_a_large_one) {
    const std::vector<std::uint32_t> blocks = sampled_blocks(1920, 1080);
    EXPECT_NEAR(static_cast<double>(blocks.size()), 240 * 135 / 8.0, 200.0);
    EXPECT_TRUE(std::ranges::is_sorted(blocks));
    EXPECT_LT(blocks.back(), 240u * 135u);
    EXPECT_GE(blocks.back(), 240u * 134u);
    // Pinned: figures of two machines are those of the same waves.
    const std::vector<std::uint32_t> smallest = sampled_blocks(64, 64);
    EXPECT_TRUE(std::ranges::equal(smallest, std::span(blocks).first(smallest.size())));
    EXPECT_EQ(smallest, (std::vector<std::uint32_t>{6, 12, 17, 19, 34, 42, 62}));
}

} // namespace manylights::lab
