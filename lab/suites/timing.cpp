#include "lab/suites/timing.h"

#include <algorithm>

namespace manylights::lab::suites {
namespace {

/// Calls visit for every technique in each round.
template <typename Visit>
void in_turn(std::vector<TimedTechnique>& techniques, std::uint32_t rounds, Visit visit) {
    for (std::uint32_t round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < techniques.size(); ++i) visit(techniques[(round + i) % techniques.size()]);
}

void forget_times(std::vector<TimedTechnique>& techniques) {
    for (TimedTechnique& timed : techniques) timed.technique->forget_times();
}

void time_warm_builds(std::vector<TimedTechnique>& techniques, const Frame& frame, const Rounds& rounds) {
    forget_times(techniques);
    in_turn(techniques, rounds.warm_blocks, [&](TimedTechnique& timed) {
        for (std::uint32_t i = 0; i < rounds.builds_per_block; ++i) timed.technique->rebuild(frame);
    });
    for (TimedTechnique& timed : techniques) {
        timed.measurement.stats.build_ms = timed.technique->stats().build_ms;
        timed.measurement.stats.stages = timed.technique->stats().stages;
    }
}

void time_cold_builds(std::vector<TimedTechnique>& techniques, const Frame& frame, std::uint32_t builds) {
    std::vector<std::uint32_t> sweep(kSweepBytes / sizeof(std::uint32_t));
    forget_times(techniques);
    in_turn(techniques, builds, [&](TimedTechnique& timed) {
        for (std::uint32_t& word : sweep) word += 1;
        timed.technique->rebuild(frame);
    });
    for (TimedTechnique& timed : techniques) timed.measurement.cold_build_ms = timed.technique->stats().build_ms;
}

void compare_with_exact(std::vector<TimedTechnique>& techniques) {
    const auto exact = std::find_if(techniques.begin(), techniques.end(),
                                    [](const TimedTechnique& timed) { return timed.measurement.technique == "exact"; });
    if (exact == techniques.end()) return;
    const std::vector<double>& limit = exact->measurement.stats.shade_ms;
    for (TimedTechnique& timed : techniques)
        for (std::size_t round = 0; round < limit.size(); ++round)
            if (limit[round] > 0.0)
                timed.measurement.shade_over_exact.push_back(timed.measurement.stats.shade_ms.at(round) / limit[round]);
}

void time_shading(std::vector<TimedTechnique>& techniques, const Frame& frame, std::uint32_t rounds) {
    forget_times(techniques);
    in_turn(techniques, rounds, [&](TimedTechnique& timed) { timed.technique->shade(frame); });
    for (TimedTechnique& timed : techniques) timed.measurement.stats.shade_ms = timed.technique->stats().shade_ms;
    compare_with_exact(techniques);
}

} // namespace

void time_techniques(std::vector<TimedTechnique>& techniques, const Frame& frame, const Rounds& rounds) {
    time_warm_builds(techniques, frame, rounds);
    time_cold_builds(techniques, frame, rounds.cold_builds);
    time_shading(techniques, frame, rounds.shade);
}

} // namespace manylights::lab::suites
