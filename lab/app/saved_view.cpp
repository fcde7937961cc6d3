#include "lab/app/saved_view.h"

#include "lab/app/option_values.h"
#include "lab/renderer/point_file.h"
#include "lab/renderer/renderer.h"
#include "lab/renderer/scene_buffers.h"
#include "lab/renderer/unfinished_file.h"
#include "lab/scene/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace manylights::lab::app {
namespace {

namespace fs = std::filesystem;

static_assert(kLargestSide <= kLargestSavedSide);

bool is_builtin(const std::string& scene) {
    const std::vector<SceneInfo> infos = builtin_scenes();
    return std::any_of(infos.begin(), infos.end(), [&](const SceneInfo& info) { return info.name == scene; });
}

bool is_same_view(const Camera& a, const Camera& b) {
    return a.position == b.position && a.forward == b.forward && a.up == b.up && a.vertical_fov == b.vertical_fov &&
           a.near_plane == b.near_plane;
}

void check_agreement(const Selectors& selectors, const Scene& scene, const SavedPoints& saved) {
    if (!selectors.camera.empty() && !is_same_view(find_camera(scene, selectors.camera), saved.camera))
        throw InputError(fmt::format("--camera '{}': must be '{}', which --points '{}' is of, or left out",
                                     selectors.camera, saved.camera.name, selectors.points));
    if (selectors.size_given && (selectors.width != saved.width || selectors.height != saved.height))
        throw InputError(fmt::format("--size '{}x{}': must be {}x{}, which --points '{}' has, or left out",
                                     selectors.width, selectors.height, saved.width, saved.height, selectors.points));
}

} // namespace

std::string scene_label(const Selectors& selectors) {
    if (!is_builtin(selectors.scene)) return fs::path(selectors.scene).filename().string();
    return selectors.scene + (selectors.detail == Detail::low ? " (low detail)" : "");
}

std::optional<SavedPoints> find_saved_points(const Selectors& selectors, const Scene& scene) {
    if (selectors.points.empty()) return std::nullopt;
    std::error_code ignored;
    if (fs::status(selectors.points, ignored).type() == fs::file_type::not_found) {
        check_writable(selectors.points);
        return std::nullopt;
    }
    SavedPoints saved = read_points(selectors.points, scene_label(selectors), material_records(scene).size());
    check_agreement(selectors, scene, saved);
    return saved;
}

Selectors with_saved_view(Selectors selectors, const std::optional<SavedPoints>& saved) {
    if (!saved) return selectors;
    selectors.camera = saved->camera.name;
    selectors.width = saved->width;
    selectors.height = saved->height;
    return selectors;
}

PointBuffer make_points(gpu::Device& device, const Selectors& selectors, const Scene& scene, const Camera& camera,
                        const std::optional<SavedPoints>& saved) {
    const std::vector<MaterialRecord> materials = material_records(scene);
    if (saved) return restore_points(device, *saved, materials);
    PointBuffer points = Renderer(device, scene).render_points(camera, selectors.width, selectors.height);
    if (selectors.points.empty()) return points;
    Camera named = camera;
    if (!selectors.camera.empty()) named.name = selectors.camera;
    write_points(selectors.points, save_points(scene_label(selectors), named, points), materials.size());
    return points;
}

} // namespace manylights::lab::app
