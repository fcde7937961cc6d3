#pragma once
// Times the builders of the suite `build` in one view, in turn.

#include "lab/suites/build_contenders.h"
#include "lab/suites/case.h"
#include "lab/suites/schema.h"

#include <optional>

namespace manylights::lab::suites {

struct BuildRounds {
    std::uint32_t blocks = 9;            ///< rounds: each has a block of warm builds and a cold one of every builder
    std::uint32_t builds_per_block = 20; ///< consecutive
};

struct BuildCase {
    SceneChoice scene;
    LightOptions lights;
    std::uint32_t width = 0, height = 0;
    BuildRounds rounds;
};

/// The view of the scene's first camera, and the lights. Keeps the scene for the next case.
class BuildSource {
  public:
    const BuildFrame& frame(const BuildCase& c);

  private:
    std::string scene_key_;
    std::optional<Scene> scene_;
    BuildFrame frame_;
};

/// A row per builder: the paper's pipeline, the library's structures on one and on two threads, the floor.
std::vector<Row> time_builds(const BuildCase& c, const BuildFrame& frame);

} // namespace manylights::lab::suites
