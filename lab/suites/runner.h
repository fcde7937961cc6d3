#pragma once
// Runs a suite's cases: the truth of each view, every technique held to it, its work counted, its times taken in turn.

#include "lab/suites/step.h"
#include "lab/suites/timing.h"
#include "lab/suites/view_source.h"

namespace manylights::lab::suites {

class Runner {
  public:
    /// remove_one_light: see RunContext.
    Runner(gpu::Device& device, Say say, std::string remove_one_light);

    /// A row per technique. One whose light sets differ from the truth's at any point has a row without figures and a
    /// line in failures. The truth is the grid oracle's, checked against brute force in every case: where that check
    /// fails, no technique has figures.
    StepResult run(const Case& c);

  private:
    struct Truth;
    Truth find_truth(const Frame& frame);
    TimedTechnique measure(const TechniqueChoice& choice, const Frame& frame, const Truth& truth);
    void count_work(TimedTechnique& timed, const Frame& frame, const Truth& truth);

    gpu::Device& device_;
    Say say_;
    std::string remove_one_light_;
    ViewSource source_;
};

} // namespace manylights::lab::suites
