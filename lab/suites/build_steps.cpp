#include "lab/scene/error.h"
#include "lab/suites/build.h"
#include "lab/suites/build_timing.h"
#include "lab/suites/suite_scenes.h"

#include <fmt/format.h>

namespace manylights::lab::suites {
namespace {

struct Plan {
    std::uint32_t width, height;
    std::vector<std::uint32_t> lights;
    BuildRounds rounds;
};

Plan plan_of(const SuiteOptions& options) {
    Plan plan = options.quick ? Plan{480, 270, {0, 256, 4096, 65536}, {3, 5}}
                              : Plan{1920, 1080, {0, 1, 16, 64, 256, 1024, 8192, 65536, 262144, 1048576}, {9, 20}};
    if (options.width != 0) plan.width = options.width, plan.height = options.height;
    if (!options.lights.empty()) plan.lights = options.lights;
    if (options.repeat != 0) plan.rounds.blocks = options.repeat;
    return plan;
}

// Many lights take long and their times differ little from round to round.
BuildRounds rounds_for(const BuildRounds& rounds, const SuiteOptions& options, std::uint32_t lights) {
    if (options.repeat != 0 || lights <= 65536) return rounds;
    return {std::min(rounds.blocks, lights <= 262144 ? 5u : 3u), rounds.builds_per_block};
}

std::string label_of(const BuildCase& c) {
    return fmt::format("{} {} {}", c.scene.name, c.lights.distribution, c.lights.count);
}

std::string id_of(const BuildCase& c) {
    return fmt::format("{}, {} detail, seed {}, radius {}, {}x{}, rounds {}x{}", label_of(c),
                       c.scene.detail == Detail::full ? "full" : "low", c.lights.seed, c.lights.radius, c.width,
                       c.height, c.rounds.blocks, c.rounds.builds_per_block);
}

void refuse_what_it_has_not(const SuiteOptions& options) {
    const auto refuse = [](const char* option, const std::vector<std::string>& values) {
        if (!values.empty()) throw InputError(fmt::format("{} '{}': the suite build has none", option, values.front()));
    };
    refuse("--techniques", options.techniques);
    refuse("--views", options.views);
}

} // namespace

StepList build_steps(const SuiteOptions& options) {
    refuse_what_it_has_not(options);
    const Plan plan = plan_of(options);
    StepList list;
    if (!has_threads()) list.skipped.emplace_back("two threads: skipped, for oneTBB was not there when this was built");
    const auto source = std::make_shared<BuildSource>();
    for (const SuiteScene& scene : select_scenes(options, list.skipped)) {
        for (const std::uint32_t lights : plan.lights) {
            if (scene.is_overlap && options.lights.empty() && lights != 65536) continue;
            BuildCase c;
            c.scene = scene_choice(scene, options);
            c.lights.distribution = scene.distribution;
            c.lights.count = lights;
            c.width = plan.width;
            c.height = plan.height;
            c.rounds = rounds_for(plan.rounds, options, lights);
            list.steps.push_back({id_of(c), label_of(c), 1.0 + static_cast<double>(lights) / 32768.0,
                                  [c, source](const RunContext& context) {
                                      context.say("building");
                                      return StepResult{time_builds(c, source->frame(c)), {}};
                                  }});
        }
    }
    return list;
}

} // namespace manylights::lab::suites
