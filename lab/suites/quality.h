#pragma once
// The suite `quality`: what each technique tests, holds and costs for the same points, from few lights to a million.
// Its figures are those of algorithms with a modelled cost, so it needs no GPU; times are ratios within a round.

#include "lab/suites/case.h"
#include "lab/suites/suite.h"

namespace manylights::lab::suites {

struct CaseList {
    std::vector<Case> cases;
    std::vector<std::string> skipped; ///< a line for each scene that is not there, and for each technique's cap
};

CaseList quality_cases(const SuiteOptions& options);
StepList quality_steps(const SuiteOptions& options);
std::string quality_tables(std::span<const Row> rows);

} // namespace manylights::lab::suites
