#include "lab/app/commands.h"
#include "lab/app/text_table.h"
#include "lab/gpu/device.h"
#include "lab/scene/error.h"
#include "lab/suites/suite.h"

#include <fmt/format.h>

namespace manylights::lab::app {
namespace {

TextTable name_and_summary() { return TextTable({{"name", Align::left}, {"summary", Align::left}}); }

std::string scene_lines() {
    TextTable table = name_and_summary();
    for (const SceneInfo& scene : builtin_scenes()) table.add({scene.name, scene.summary});
    return table.str(false);
}

// One line each, and the options of each indented below it.
std::string technique_lines() {
    TextTable techniques = name_and_summary();
    for (const TechniqueInfo& technique : technique_infos()) {
        techniques.add({technique.name, technique.summary});
        for (const OptionInfo& option : technique.options) {
            techniques.add({"", fmt::format("--set {}=...  {}; {}", option.key, option.meaning, option.values)});
        }
    }
    return techniques.str(false);
}

std::string suite_lines() {
    TextTable table = name_and_summary();
    for (const suites::Suite& suite : suites::suites()) table.add({suite.name, suite.summary});
    return table.str(false);
}

std::string device_lines() {
    TextTable table({{"index", Align::right}, {"name", Align::left}, {"driver", Align::left}, {"kind", Align::left}});
    const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
    if (devices.empty())
        throw DeviceError("no device with Vulkan 1.3: install a driver, or run scripts/setup for a software one");
    for (std::size_t i = 0; i < devices.size(); ++i)
        table.add(
            {std::to_string(i), devices[i].name, devices[i].version, devices[i].is_software ? "software" : "GPU"});
    return table.str(false);
}

} // namespace

int run_list(const ListArguments& arguments) {
    switch (arguments.what) {
    case ListKind::scenes:
        fmt::print("{}", scene_lines());
        break;
    case ListKind::techniques:
        fmt::print("{}", technique_lines());
        break;
    case ListKind::suites:
        fmt::print("{}", suite_lines());
        break;
    case ListKind::devices:
        fmt::print("{}", device_lines());
        break;
    }
    return kDone;
}

} // namespace manylights::lab::app
