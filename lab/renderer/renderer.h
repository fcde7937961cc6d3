#pragma once
// Draws a scene into the points that are shaded.

#include "lab/renderer/point_buffer.h"
#include "lab/scene/scene.h"

#include <memory>

namespace manylights::lab {

namespace gpu {
class Device;
}

/// A scene on the device, and the passes that turn a camera into points. The scene must outlive the renderer.
class Renderer {
  public:
    Renderer(gpu::Device& device, const Scene& scene);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// The nearest surface at every pixel centre. The view depth is what the rasteriser's depth buffer holds, and the
    /// position is computed from the pixel and that depth by one function, so all techniques shade the same points.
    PointBuffer render_points(const Camera& camera, std::uint32_t width, std::uint32_t height);

    /// The same into points made earlier; every byte of the positions and normals is written.
    void render_points(const Camera& camera, PointBuffer& target);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace manylights::lab
