#include "lab/app/workbench.h"

#include "lab/app/number_scale.h"
#include "lab/app/saved_view.h"
#include "lab/scene/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace manylights::lab::app {
namespace {

gpu::DeviceOptions device_options(const Selectors& selectors) { return {selectors.device, selectors.validation}; }

PointBuffer checked_points(gpu::Device& device, const Selectors& selectors, const Scene& scene, const Camera& camera,
                           const std::optional<SavedPoints>& saved) {
    check_memory(selectors, scene, device.info());
    return make_points(device, selectors, scene, camera, saved);
}

Selectors with_scene_distribution(Selectors selectors, const Scene& scene) {
    if (selectors.scene_distribution) selectors.lights.distribution = scene.distribution;
    return selectors;
}

} // namespace

// What any technique holds on the device at the least: two vec4 per point, a 64-byte record and an RGBA float per
// pixel, and two vec4 per light.
void check_memory(const Selectors& selectors, const Scene& scene, const gpu::DeviceInfo& device) {
    constexpr double kGibibyte = 1024.0 * 1024.0 * 1024.0;
    const std::uint64_t pixels = std::uint64_t{selectors.width} * selectors.height;
    const std::uint64_t bytes = pixels * (32 + 64 + 16) + std::uint64_t{selectors.lights.count} * 32 +
                                scene.vertices.size() * sizeof(Vertex) + scene.indices.size() * 4;
    if (bytes <= device.memory_bytes) return;
    throw InputError(fmt::format("--size {}x{} with {} lights: needs at least {:.1f} GiB, {} has {:.1f} GiB",
                                 selectors.width, selectors.height, selectors.lights.count,
                                 static_cast<double>(bytes) / kGibibyte, device.name,
                                 static_cast<double>(device.memory_bytes) / kGibibyte));
}

Workbench::Workbench(const Selectors& selectors)
    : scene_(load_scene(selectors.scene, selectors.detail)), saved_(find_saved_points(selectors, scene_)),
      selectors_(with_scene_distribution(with_saved_view(selectors, saved_), scene_)),
      camera_(saved_ ? saved_->camera : find_camera(scene_, selectors.camera)),
      lights_(make_lights(scene_, camera_, selectors_.lights)), device_(device_options(selectors)),
      points_(checked_points(device_, selectors_, scene_, camera_, saved_)), frame_{scene_,           camera_,
                                                                                    selectors_.width, selectors_.height,
                                                                                    lights_.lights,   points_} {}

std::string Workbench::description() const {
    return fmt::format("{}, {} lights ({}, seed {}), camera {}, {}x{}{}, {}", selectors_.scene,
                       with_separators(lights_.lights.size()), selectors_.lights.distribution, selectors_.lights.seed,
                       camera_name(), selectors_.width, selectors_.height,
                       saved_ ? fmt::format(", points from {}", selectors_.points) : "", device_.info().name);
}

std::string Workbench::camera_name() const { return selectors_.camera.empty() ? camera_.name : selectors_.camera; }

suites::RowView Workbench::row_view() const {
    return {selectors_.scene, selectors_.lights, camera_name(), selectors_.width, selectors_.height};
}

std::vector<std::uint8_t> Workbench::shaded_mask() const {
    std::vector<std::uint8_t> mask;
    for (const PointPosition& point : points_.download_positions()) mask.push_back(point.depth > 0.0f ? 1 : 0);
    return mask;
}

OptionValues Workbench::options_for(const std::string& technique) const {
    OptionValues options;
    for (const TechniqueInfo& info : technique_infos()) {
        if (info.name != technique) continue;
        for (const auto& setting : selectors_.settings)
            if (std::any_of(info.options.begin(), info.options.end(),
                            [&](const OptionInfo& option) { return option.key == setting.first; }))
                options.push_back(setting);
    }
    return options;
}

std::unique_ptr<Technique> Workbench::make_prepared(const std::string& name, int builds) {
    std::unique_ptr<Technique> technique = make_technique(device_, name, options_for(name));
    technique->prepare(frame_);
    for (int build = 1; build < builds; ++build) technique->rebuild(frame_);
    return technique;
}

} // namespace manylights::lab::app
