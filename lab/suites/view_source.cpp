#include "lab/suites/view_source.h"

#include <fmt/format.h>

namespace manylights::lab::suites {

const Frame& ViewSource::frame(const Case& c) {
    frame_.reset();
    use_scene(c.scene);
    const Camera camera = case_camera(*scene_, c.view);
    use_lights(c, camera);
    use_points(c, camera);
    frame_.emplace(Frame{*scene_, camera, c.width, c.height, lights_.lights, *points_});
    return *frame_;
}

void ViewSource::use_scene(const SceneChoice& choice) {
    const std::string key = fmt::format("{} {}", choice.source, static_cast<int>(choice.detail));
    if (scene_ && key == scene_key_) return;
    points_.reset(); // its materials are the scene's
    renderer_.reset();
    lights_key_.clear();
    scene_ = load_scene(choice.source, choice.detail);
    renderer_.emplace(device_, *scene_);
    scene_key_ = key;
}

// Only the distribution `view` depends on the camera.
void ViewSource::use_lights(const Case& c, const Camera& camera) {
    const LightOptions& o = c.lights;
    std::string key = fmt::format("{} {} {} {}", o.count, o.distribution, o.seed, o.radius);
    if (o.distribution == "view") key += " " + camera.name;
    if (key == lights_key_) return;
    lights_ = make_lights(*scene_, camera, o);
    lights_key_ = key;
}

void ViewSource::use_points(const Case& c, const Camera& camera) {
    if (points_ && points_->width() == c.width && points_->height() == c.height)
        renderer_->render_points(camera, *points_);
    else
        points_.emplace(renderer_->render_points(camera, c.width, c.height));
}

} // namespace manylights::lab::suites
