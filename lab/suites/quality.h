#pragma once
// The suite `quality`: what each technique tests, holds and costs for the same points, from few lights to a million.
// Its figures are those of algorithms with a modelled cost, so it needs no GPU; times are ratios within a round.

#include "lab/suites/suite.h"

namespace manylights::lab::suites {

CaseList quality_cases(const SuiteOptions& options);
std::string quality_tables(std::span<const Row> rows);

} // namespace manylights::lab::suites
