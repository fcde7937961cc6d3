#pragma once
// What a suite's run does one after the other: a step measures one view, and its rows are kept as soon as it is done.

#include "lab/suites/row.h"

#include <functional>
#include <string>
#include <vector>

namespace manylights::lab::suites {

struct StepResult {
    std::vector<Row> rows;
    std::vector<std::string> failures; ///< a line for each technique whose light sets are wrong
};

/// Says what long work is at.
using Say = std::function<void(const std::string& what)>;

/// What the steps of a run share.
struct RunContext {
    gpu::Device* device = nullptr; ///< null where the suite needs none
    Say say;
    std::string remove_one_light; ///< technique to damage on purpose, or kGridOracle; empty: none
};

struct Step {
    std::string id;    ///< everything that it is, in one line: two with the same text give the same rows, times apart
    std::string label; ///< the same for a person who waits
    double weight = 1; ///< what it takes, in units that are about equal
    std::function<StepResult(const RunContext&)> run;
};

struct StepList {
    std::vector<Step> steps;
    std::vector<std::string> skipped; ///< a line for each scene that is not there, and the like
};

} // namespace manylights::lab::suites
