#include "lab/suites/suite_scenes.h"

#include "lab/scene/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace manylights::lab::suites {
namespace {

// Lights in the volume or near surfaces, as algorithms and papers measured scenes of their kinds, and lights of 0.5 to
// 5 m spread evenly over 200 m of the view.
constexpr SuiteScene kScenes[] = {{"canyon", "canyon", nullptr, "volume"},
                                  {"citadel", "citadel", nullptr, "surface"},
                                  {"bars", "bars", nullptr, "volume"},
                                  {"sponza", "sponza", "sponza/sponza.glb", "surface"},
                                  {"view", "canyon", nullptr, "view", true}};

} // namespace

std::vector<SuiteScene> select_scenes(const SuiteOptions& options, std::vector<std::string>& skipped) {
    std::vector<std::string> known;
    for (const SuiteScene& scene : kScenes) known.emplace_back(scene.key);
    check_names("--scenes", options.scenes, known);
    std::vector<SuiteScene> selected;
    for (const SuiteScene& scene : kScenes) {
        if (!options.scenes.empty() &&
            std::find(options.scenes.begin(), options.scenes.end(), scene.key) == options.scenes.end())
            continue;
        const std::string source = scene_choice(scene, options).source;
        if (scene.file != nullptr && !std::filesystem::exists(source))
            skipped.push_back(fmt::format("{}: skipped, for {} is not there", scene.name, source));
        else
            selected.push_back(scene);
    }
    return selected;
}

SceneChoice scene_choice(const SuiteScene& scene, const SuiteOptions& options) {
    if (scene.file == nullptr) return {scene.name, scene.name, options.detail};
    return {scene.name, (std::filesystem::path(options.scene_folder) / scene.file).string(), options.detail};
}

void check_names(const char* option, const std::vector<std::string>& names, const std::vector<std::string>& known) {
    for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw InputError(fmt::format("{} '{}': must be one of {}", option, name, fmt::join(known, ", ")));
}

} // namespace manylights::lab::suites
