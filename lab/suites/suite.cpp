#include "lab/suites/suite.h"

#include "lab/scene/error.h"
#include "lab/suites/build.h"
#include "lab/suites/quality.h"

#include <fmt/format.h>

namespace manylights::lab::suites {
namespace {

constexpr Suite kSuites[] = {
    {"quality", "lights tested, structure, modelled wave cost and shading time of techniques in four scenes", true,
     schema, quality_steps, quality_tables},
    {"build", "build times of the library's structures beside the paper's pipeline and the floor of the machine", false,
     build_columns, build_steps, build_tables},
};

} // namespace

std::span<const Suite> suites() { return kSuites; }

const Suite& find_suite(const std::string& name) {
    std::vector<std::string> names;
    for (const Suite& suite : kSuites) {
        if (suite.name == name) return suite;
        names.emplace_back(suite.name);
    }
    throw InputError(fmt::format("suite '{}': must be one of {}", name, fmt::join(names, ", ")));
}

} // namespace manylights::lab::suites
