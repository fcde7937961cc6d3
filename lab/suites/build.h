#pragma once
// The suite `build`: what building costs on the CPU. The library's structures, on one thread and on two, beside the
// paper's pipeline and beside what the machine cannot do faster, in one run. Times are ratios within a round.

#include "lab/suites/suite.h"

namespace manylights::lab::suites {

std::span<const Column> build_columns();
StepList build_steps(const SuiteOptions& options);
std::string build_tables(std::span<const Row> rows);

} // namespace manylights::lab::suites
