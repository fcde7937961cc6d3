#include "lab/app/technique_arguments.h"

#include "lab/scene/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace manylights::lab::app {
namespace {

std::string joined(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

} // namespace

std::vector<std::string> technique_names() {
    std::vector<std::string> names;
    for (const TechniqueInfo& info : technique_infos()) names.push_back(info.name);
    return names;
}

void check_technique(const std::string& option, const std::string& name, const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), name) == known.end())
        throw InputError(fmt::format("{} '{}': unknown technique; there are {}", option, name, joined(known)));
}

std::vector<std::string> read_techniques(const std::vector<std::string>& given) {
    const std::vector<std::string> known = technique_names();
    if (given == std::vector<std::string>{"all"}) return known;
    for (auto name = given.begin(); name != given.end(); ++name) {
        check_technique("--techniques", *name, known);
        if (std::find(given.begin(), name, *name) != name)
            throw InputError(fmt::format("--techniques '{}': is given twice", *name));
    }
    return given;
}

void check_setting_keys(const OptionValues& settings, const std::vector<std::string>& techniques) {
    for (const auto& [key, value] : settings) {
        bool known = false;
        std::vector<std::string> keys;
        for (const TechniqueInfo& info : technique_infos()) {
            if (std::find(techniques.begin(), techniques.end(), info.name) == techniques.end()) continue;
            for (const OptionInfo& option : info.options) {
                known = known || option.key == key;
                if (std::find(keys.begin(), keys.end(), option.key) == keys.end()) keys.push_back(option.key);
            }
        }
        if (!known)
            throw InputError(fmt::format("--set '{}={}': unknown option of {}; {}", key, value, joined(techniques),
                                         keys.empty() ? "it has none" : "there are " + joined(keys)));
    }
}

} // namespace manylights::lab::app
