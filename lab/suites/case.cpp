#include "lab/suites/case.h"

#include "lab/scene/error.h"

#include <fmt/format.h>

namespace manylights::lab::suites {
namespace {

std::string view_text(const ViewChoice& view) {
    return fmt::format("{} {}", view.on_path ? "frame" : "camera", view.index);
}

std::string technique_text(const TechniqueChoice& technique) {
    std::string text = technique.name;
    for (const auto& [key, value] : technique.options) text += fmt::format(" {}={}", key, value);
    return text;
}

} // namespace

Camera case_camera(const Scene& scene, const ViewChoice& view) {
    const std::vector<Camera>& cameras = view.on_path ? scene.path : scene.cameras;
    if (view.index >= cameras.size())
        throw InputError(fmt::format("scene \"{}\": has no {}", scene.name, view_text(view)));
    Camera camera = cameras[view.index];
    // The selector that shows the same frame with `render`.
    if (view.on_path)
        camera.name = fmt::format("path:{}", static_cast<double>(view.index) / static_cast<double>(cameras.size()));
    return camera;
}

std::string case_label(const Case& c) {
    return fmt::format("{} {} {}, {}", c.scene.name, c.lights.distribution, c.lights.count, view_text(c.view));
}

std::string case_id(const Case& c) {
    std::string techniques;
    for (const TechniqueChoice& technique : c.techniques)
        techniques += (techniques.empty() ? "" : ", ") + technique_text(technique);
    return fmt::format("{}, {} detail, seed {}, radius {}, {}x{}, rounds {}/{}x{}/{}: {}", case_label(c),
                       c.scene.detail == Detail::full ? "full" : "low", c.lights.seed, c.lights.radius, c.width,
                       c.height, c.rounds.shade, c.rounds.warm_blocks, c.rounds.builds_per_block, c.rounds.cold_builds,
                       techniques);
}

} // namespace manylights::lab::suites
