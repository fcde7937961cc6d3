#pragma once
// A case of a suite: one view, and the techniques that are compared in it.

#include "lab/scene/scene.h"
#include "lab/techniques/technique.h"

#include <string>
#include <vector>

namespace manylights::lab::suites {

/// A scene by the name that its rows carry, and what load_scene takes: the same name, or a file's path.
struct SceneChoice {
    std::string name, source;
    Detail detail = Detail::full;
};

/// One of the scene's cameras, or one of the 16 frames of its path.
struct ViewChoice {
    bool on_path = false;
    std::uint32_t index = 0;
};

struct TechniqueChoice {
    std::string name;
    OptionValues options;
};

/// How often things are timed. All zero: only work is counted.
struct Rounds {
    std::uint32_t shade = 0;
    std::uint32_t warm_blocks = 0;
    std::uint32_t builds_per_block = 0; ///< consecutive: from the second on, a technique's data is in the caches
    std::uint32_t cold_builds = 0;
};

struct Case {
    SceneChoice scene;
    LightOptions lights;
    ViewChoice view;
    std::uint32_t width = 0, height = 0;
    std::vector<TechniqueChoice> techniques;
    Rounds rounds;
};

/// The view's camera. Throws InputError where the scene has fewer cameras.
Camera case_camera(const Scene& scene, const ViewChoice& view);

/// Everything that the case is, in one line: two cases with the same text give the same rows, times apart.
std::string case_id(const Case& c);

/// The same for a person who waits: scene, lights and view.
std::string case_label(const Case& c);

} // namespace manylights::lab::suites
