#include "lab/app/bench_arguments.h"

#include "lab/app/option_values.h"
#include "lab/app/technique_arguments.h"

#include <CLI/CLI.hpp>

#include <cstdlib>

namespace manylights::lab::app {
namespace {

constexpr std::array<const char*, 2> kDetailNames = {"low", "full"};
constexpr std::uint32_t kMostRounds = 1000;

// Beside the project, unless the environment says where they are.
std::string default_scene_folder() {
    const char* folder = std::getenv("MANYLIGHTS_SCENES");
    return folder != nullptr ? folder : MANYLIGHTS_SOURCE_DIR "/../shared/scenes";
}

CLI::Option* add_list(CLI::App& app, const char* name, std::vector<std::string>& values, const char* help) {
    return app.add_option(name, values, help)->delimiter(',')->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

} // namespace

void add_bench(CLI::App& app, BenchOptions& bench) {
    BenchArguments& arguments = bench.arguments;
    suites::SuiteOptions& options = arguments.options;
    options.scene_folder = default_scene_folder();
    app.add_option("suite", arguments.suite, "see `list suites`")->required();
    app.add_option("--out", arguments.out, "folder for SUITE.json, .csv, .md and the journal of a run")->required();
    app.add_flag("--quick", options.quick, "a small part of the suite, in minutes");
    app.add_flag("--resume", arguments.resume, "go on where a run into the same folder was stopped");
    app.add_option("--repeat", bench.repeat, "rounds of everything that is timed [the suite's]");
    add_list(app, "--scenes", options.scenes, "NAME,NAME,... of the suite's scenes [all]");
    add_list(app, "--lights", bench.lights, "N,N,... [the suite's]");
    add_list(app, "--techniques", bench.techniques, "NAME,NAME,... or all [the suite's]");
    add_list(app, "--views", options.views, "cameras, path [both]");
    app.add_option("--size", bench.size, "WIDTHxHEIGHT in pixels [the suite's]");
    app.add_option("--detail", bench.detail, "of built-in scenes: low or full [full]");
    app.add_option("--scene-folder", options.scene_folder, "where scenes from files lie [$MANYLIGHTS_SCENES]");
    app.add_option("--device", arguments.device, "index in `list devices` or part of a name [the best one]");
    app.add_flag("--validation", arguments.validation, "run under core and synchronization validation");
    // For tests of the proof itself: an empty group keeps it out of the help.
    app.add_option("--remove-one-light", arguments.remove_one_light)->group("");
}

BenchArguments finish_bench(const BenchOptions& bench) {
    BenchArguments arguments = bench.arguments;
    suites::SuiteOptions& options = arguments.options;
    if (!bench.repeat.empty()) options.repeat = whole_number("--repeat", bench.repeat, 1, kMostRounds);
    for (const std::string& count : bench.lights)
        options.lights.push_back(whole_number("--lights", count, 0, kMostLights));
    if (!bench.techniques.empty()) options.techniques = read_techniques(bench.techniques);
    if (!bench.size.empty()) {
        const ImageSize size = image_size("--size", bench.size);
        options.width = size.width;
        options.height = size.height;
    }
    options.detail = choice("--detail", bench.detail, kDetailNames) == 0 ? Detail::low : Detail::full;
    suites::find_suite(arguments.suite);
    if (!arguments.remove_one_light.empty() && arguments.remove_one_light != kGridOracle)
        check_technique("--remove-one-light", arguments.remove_one_light, technique_names());
    return arguments;
}

} // namespace manylights::lab::app
