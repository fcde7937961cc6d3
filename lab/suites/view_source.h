#pragma once
// Makes the frames of a suite's cases, and keeps scene, lights and points for the next case that wants the same.

#include "lab/renderer/renderer.h"
#include "lab/suites/case.h"

#include <optional>

namespace manylights::lab::suites {

class ViewSource {
  public:
    explicit ViewSource(gpu::Device& device) : device_(device) {}
    ViewSource(const ViewSource&) = delete;
    ViewSource& operator=(const ViewSource&) = delete;

    /// The case's frame, valid until the next call. Throws InputError and DeviceError.
    const Frame& frame(const Case& c);

  private:
    void use_scene(const SceneChoice& choice);
    void use_lights(const Case& c, const Camera& camera);
    void use_points(const Case& c, const Camera& camera);

    gpu::Device& device_;
    std::string scene_key_, lights_key_;
    std::optional<Scene> scene_;
    std::optional<Renderer> renderer_;
    LightSet lights_;
    std::optional<PointBuffer> points_;
    std::optional<Frame> frame_;
};

} // namespace manylights::lab::suites
