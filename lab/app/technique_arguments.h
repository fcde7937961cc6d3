#pragma once
// Names of techniques and their settings on the command line. All throw InputError naming the option and the choices.

#include "lab/techniques/technique.h"

namespace manylights::lab::app {

std::vector<std::string> technique_names();

void check_technique(const std::string& option, const std::string& name, const std::vector<std::string>& known);

/// --techniques: "all" stands for every technique, brute force included; none may be named twice.
std::vector<std::string> read_techniques(const std::vector<std::string>& given);

/// --set: a key is for those of the techniques that have it; one that none of them has is a mistake.
void check_setting_keys(const OptionValues& settings, const std::vector<std::string>& techniques);

} // namespace manylights::lab::app
