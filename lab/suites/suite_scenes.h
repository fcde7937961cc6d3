#pragma once
// The scenes that suites measure, and where they are found.

#include "lab/suites/case.h"
#include "lab/suites/suite.h"

namespace manylights::lab::suites {

struct SuiteScene {
    const char* key; ///< what --scenes selects it by
    const char* name;
    const char* file; ///< in the folder of real scenes; null: built in
    const char* distribution;
    bool is_overlap = false; ///< each light covers tens of tiles: one number of lights, and the cameras alone
};

/// Those that the options select, and that are there; a line in skipped for each that is not. Throws InputError where
/// --scenes names another.
std::vector<SuiteScene> select_scenes(const SuiteOptions& options, std::vector<std::string>& skipped);

SceneChoice scene_choice(const SuiteScene& scene, const SuiteOptions& options);

/// Throws InputError where one of the names is unknown.
void check_names(const char* option, const std::vector<std::string>& names, const std::vector<std::string>& known);

} // namespace manylights::lab::suites
