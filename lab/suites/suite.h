#pragma once
// The suites: each a list of steps, and the tables that its rows are read by. One line per suite in suite.cpp.

#include "lab/scene/scene.h"
#include "lab/suites/schema.h"
#include "lab/suites/step.h"

namespace manylights::lab::suites {

/// What a run takes of a suite; empty or zero: all of it, by the suite's own choice.
struct SuiteOptions {
    bool quick = false;              ///< a small image, few views, lights and rounds: minutes instead of an hour
    std::vector<std::string> scenes; ///< names of the suite's scenes
    std::vector<std::uint32_t> lights;
    std::vector<std::string> techniques;
    std::vector<std::string> views; ///< "cameras", "path"
    std::uint32_t width = 0, height = 0;
    std::uint32_t repeat = 0;     ///< rounds of everything that is timed
    Detail detail = Detail::full; ///< of built-in scenes
    std::string scene_folder;     ///< where real scenes lie
};

struct Suite {
    const char* name;
    const char* summary;
    bool needs_device;
    std::span<const Column> (*columns)(); ///< of its rows
    /// Throws InputError where an option names what the suite does not have.
    StepList (*steps)(const SuiteOptions& options);
    std::string (*tables)(std::span<const Row> rows); ///< Markdown
};

std::span<const Suite> suites();
/// Throws InputError naming the suites.
const Suite& find_suite(const std::string& name);

} // namespace manylights::lab::suites
