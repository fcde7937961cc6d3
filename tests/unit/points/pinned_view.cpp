#include "tests/unit/points/pinned_view.h"

#include "lab/renderer/point_file.h"
#include "lab/renderer/scene_buffers.h"

namespace manylights::lab {

LoadedView load_view(const PinnedView& pinned) {
    LoadedView view;
    view.scene = load_scene(pinned.scene);
    const std::string path = std::string(MANYLIGHTS_SOURCE_DIR "/tests/data/points/") + pinned.scene + ".points";
    view.saved = read_points(path, pinned.scene, material_records(view.scene).size());
    LightOptions options;
    options.count = kPinnedLights;
    options.distribution = pinned.distribution;
    options.radius = pinned.radius;
    view.lights = make_lights(view.scene, view.saved.camera, options).lights;
    return view;
}

} // namespace manylights::lab
