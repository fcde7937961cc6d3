#pragma once
// Times of several techniques that compare: taken in turn inside one run, never one technique after the other, so that
// a machine which slows down slows all of them.

#include "lab/suites/case.h"
#include "lab/suites/row.h"

#include <memory>

namespace manylights::lab::suites {

/// Bytes that are read and written before a cold build: more than the second-level cache of a core.
constexpr std::size_t kSweepBytes = std::size_t{8} << 20;

struct TimedTechnique {
    std::unique_ptr<Technique> technique; ///< prepared
    Measurement measurement;              ///< filled in
    std::string failure;                  ///< what is wrong with its light sets; empty: nothing
};

/// Warm builds in alternating blocks, cold builds each behind a sweep of the cache, shading in rounds. Within a round
/// the order is turned by one from round to round. Fills build_ms, stages, cold_build_ms, shade_ms and, where `exact`
/// is among the techniques, shade_over_exact.
void time_techniques(std::vector<TimedTechnique>& techniques, const Frame& frame, const Rounds& rounds);

} // namespace manylights::lab::suites
