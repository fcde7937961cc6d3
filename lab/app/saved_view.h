#pragma once
// `--points FILE`: a view's points are saved the first time and loaded from then on, with their camera and their size.

#include "lab/app/arguments.h"
#include "lab/gpu/device.h"
#include "lab/renderer/point_buffer.h"
#include "lab/renderer/saved_points.h"

#include <optional>

namespace manylights::lab::app {

/// The scene's name without folders, and the detail where it is not the full one: what saved points belong to.
std::string scene_label(const Selectors& selectors);

/// What the file holds; nothing where no file is selected or it is not there yet. Throws InputError where the file is
/// bad, cannot be written once the points are drawn, or is of another scene, camera or size than selected.
std::optional<SavedPoints> find_saved_points(const Selectors& selectors, const Scene& scene);

/// The selectors, with the camera and the size of the saved points where there are some.
Selectors with_saved_view(Selectors selectors, const std::optional<SavedPoints>& saved);

/// Loads the saved points; or draws the scene's, and saves them where a file is selected.
PointBuffer make_points(gpu::Device& device, const Selectors& selectors, const Scene& scene, const Camera& camera,
                        const std::optional<SavedPoints>& saved);

} // namespace manylights::lab::app
