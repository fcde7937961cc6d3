#include "lab/suites/quality.h"
#include "lab/suites/runner.h"
#include "lab/suites/suite_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <span>

namespace manylights::lab::suites {
namespace {

constexpr std::uint32_t kCameras = 4, kPathFrames = 16;

/// What the suite runs of its own accord.
struct Plan {
    std::uint32_t width, height;
    std::vector<std::uint32_t> lights;
    std::vector<std::uint32_t> main_lights; ///< of them, those with the path and with times
    std::vector<std::uint32_t> cameras, frames;
    Rounds rounds;
    std::vector<std::uint32_t> rival_lights{}; ///< those of the lights with the rivals
    bool is_overlap = false;
};

std::vector<std::uint32_t> numbers_below(std::uint32_t end, std::uint32_t step) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < end; i += step) numbers.push_back(i);
    return numbers;
}

Plan plan_of(const SuiteOptions& options) {
    Plan plan =
        options.quick
            ? Plan{480, 270, {4096, 65536, 1048576}, {65536, 1048576}, {0}, numbers_below(kPathFrames, 8), {3, 2, 3, 3}}
            : Plan{1920,
                   1080,
                   {1024, 8192, 65536, 262144, 1048576},
                   {65536, 1048576},
                   numbers_below(kCameras, 1),
                   numbers_below(kPathFrames, 1),
                   {5, 3, 5, 5}};
    plan.rival_lights = {65536};
    if (!options.quick) plan.rival_lights.insert(plan.rival_lights.end(), {8192, 1048576});
    if (options.width != 0) plan.width = options.width, plan.height = options.height;
    if (!options.lights.empty()) plan.lights = plan.main_lights = options.lights;
    if (options.repeat != 0)
        plan.rounds = {options.repeat, options.repeat, plan.rounds.builds_per_block, options.repeat};
    const auto wanted = [&](const char* views) {
        return options.views.empty() ||
               std::find(options.views.begin(), options.views.end(), views) != options.views.end();
    };
    if (!wanted("cameras")) plan.cameras.clear();
    if (!wanted("path")) plan.frames.clear();
    return plan;
}

Plan overlap_plan(Plan plan, const SuiteOptions& options) {
    if (options.lights.empty()) plan.lights = plan.main_lights = {65536};
    plan.frames.clear();
    plan.is_overlap = true;
    return plan;
}

// The settings that Tiled Light Trees was measured with (section 4.2), for its structures and its baseline alike;
// others are as they are by default.
OptionValues options_of(const std::string& technique) {
    OptionValues options{{"tile_size", "48"}};
    if (technique == "clustered" || technique == "hybrid_light_trees") options.emplace_back("slice_count", "16");
    if (technique == "tiled_light_trees" || technique == "hybrid_light_trees") options.emplace_back("leaf_size", "4");
    return options.size() > 1 ? options : OptionValues{};
}

// The best that lists can do: finer grids than the papers have, cells tested tightly, lists walked by whole waves.
// Only where lights are many, and beside the settings above.
const OptionValues kRivals[] = {
    {{"tile_size", "32"}, {"slice_count", "64"}, {"cell_test", "tight"}, {"loop", "wave"}},
    {{"tile_size", "16"}, {"slice_count", "128"}, {"cell_test", "tight"}, {"loop", "wave"}}};

// Where each light covers tens of tiles the finest grid's lists take hundreds of MiB, more than a buffer of a software
// device holds.
void add_rivals(std::vector<TechniqueChoice>& choices, bool is_overlap) {
    auto place = std::find_if(choices.begin(), choices.end(),
                              [](const TechniqueChoice& choice) { return choice.name == "clustered"; });
    if (place == choices.end()) return;
    for (const OptionValues& options : std::span(kRivals).first(is_overlap ? 1 : std::size(kRivals)))
        place = choices.insert(place + 1, {"clustered", options});
}

// Where a run names no technique: the limit, and what builds on the host. The others build on the device, which a
// software driver takes seconds for.
constexpr const char* kUsual[] = {"exact",         "clustered",         "tiled_light_trees", "hybrid_light_trees",
                                  "depth_windows", "depth_windows_wave"};

bool is_wanted(const SuiteOptions& options, const std::string& technique) {
    if (options.techniques.empty())
        return std::find(std::begin(kUsual), std::end(kUsual), technique) != std::end(kUsual);
    return std::find(options.techniques.begin(), options.techniques.end(), technique) != options.techniques.end();
}

std::vector<TechniqueChoice> techniques_of(const SuiteOptions& options) {
    std::vector<TechniqueChoice> choices;
    for (const TechniqueInfo& info : technique_infos())
        if (is_wanted(options, info.name)) choices.push_back({info.name, options_of(info.name)});
    return choices;
}

/// Where more lights would tell nothing, or not in a night.
struct Cap {
    const char* technique;
    std::uint32_t most_lights;
    const char* reason;
};
constexpr Cap kCaps[] = {
    {"brute_force", 4096, "it tests each light at each point"},
    {"light_volumes", 4096, "it draws them all in one submission, which a software device does not end in time"},
};

const Cap* cap_of(const TechniqueChoice& choice) {
    const auto* cap = std::find_if(std::begin(kCaps), std::end(kCaps),
                                   [&](const Cap& candidate) { return choice.name == candidate.technique; });
    return cap != std::end(kCaps) ? cap : nullptr;
}

// Masks of more lights for tiles of 32 pixels, the default, are larger than a buffer of a software device (1920x1080).
constexpr std::uint32_t kMostLightsOfSmallMasks = 524288;

std::vector<TechniqueChoice> choices_for(const std::vector<TechniqueChoice>& choices, std::uint32_t lights) {
    std::vector<TechniqueChoice> within;
    for (const TechniqueChoice& choice : choices)
        if (const Cap* cap = cap_of(choice); cap == nullptr || lights <= cap->most_lights) within.push_back(choice);
    for (TechniqueChoice& choice : within)
        if (choice.name == "z_bins" && lights > kMostLightsOfSmallMasks) choice.options = {{"tile_size", "64"}};
    return within;
}

/// A line for each technique that some of the cases are without.
std::vector<std::string> describe_caps(const std::vector<TechniqueChoice>& choices, const Plan& plan) {
    std::vector<std::string> lines;
    const std::uint32_t most = plan.lights.empty() ? 0 : *std::max_element(plan.lights.begin(), plan.lights.end());
    for (const TechniqueChoice& choice : choices)
        if (const Cap* cap = cap_of(choice); cap != nullptr && most > cap->most_lights)
            lines.push_back(
                fmt::format("{}: only up to {} lights, for {}", choice.name, cap->most_lights, cap->reason));
    return lines;
}

bool contains(const std::vector<std::uint32_t>& numbers, std::uint32_t number) {
    return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
}

void add_cases(std::vector<Case>& cases, const Case& scene_case, const Plan& plan) {
    for (const std::uint32_t lights : plan.lights) {
        Case c = scene_case;
        c.lights.count = lights;
        const bool is_main = contains(plan.main_lights, lights);
        if (is_main) c.rounds = plan.rounds;
        c.techniques = choices_for(scene_case.techniques, lights);
        if (contains(plan.rival_lights, lights)) add_rivals(c.techniques, plan.is_overlap);
        for (const std::uint32_t camera : plan.cameras) {
            c.view = {false, camera};
            cases.push_back(c);
        }
        c.rounds = {};
        for (const std::uint32_t frame : is_main ? plan.frames : std::vector<std::uint32_t>{}) {
            c.view = {true, frame};
            cases.push_back(c);
        }
    }
}

/// What a case takes, in units that are about equal: a fixed share, and the lights' share.
double weight(const Case& c) { return 1.0 + static_cast<double>(c.lights.count) / 262144.0; }

} // namespace

CaseList quality_cases(const SuiteOptions& options) {
    check_names("--views", options.views, {"cameras", "path"});
    const Plan plan = plan_of(options);
    CaseList list;
    list.skipped = describe_caps(techniques_of(options), plan);
    for (const SuiteScene& scene : select_scenes(options, list.skipped)) {
        Case c;
        c.scene = scene_choice(scene, options);
        c.lights.distribution = scene.distribution;
        c.width = plan.width;
        c.height = plan.height;
        c.techniques = techniques_of(options);
        add_cases(list.cases, c, scene.is_overlap ? overlap_plan(plan, options) : plan);
    }
    return list;
}

StepList quality_steps(const SuiteOptions& options) {
    CaseList list = quality_cases(options);
    StepList steps{{}, std::move(list.skipped)};
    // One runner for all, made by the first step: it keeps scene, lights and points.
    const auto runner = std::make_shared<std::optional<Runner>>();
    for (const Case& c : list.cases)
        steps.steps.push_back({case_id(c), case_label(c), weight(c), [c, runner](const RunContext& context) {
                                   if (!*runner)
                                       runner->emplace(*context.device, context.say, context.remove_one_light);
                                   return (*runner)->run(c);
                               }});
    return steps;
}

} // namespace manylights::lab::suites
