#pragma once
// Draws a scene's triangles, both sides of each, into depth, normal and material.

#include "lab/renderer/scene_buffers.h"

#include <memory>

namespace manylights::lab {

namespace gpu {
class Commands;
}

/// The same text as CameraAxes in point.glsl: 64 bytes of push constants.
struct CameraAxes {
    glm::vec3 position;
    float near_plane;
    glm::vec3 right;
    float tan_half_x;
    glm::vec3 up;
    float tan_half_y;
    glm::vec3 forward;
    float unused = 0.0f;
};
static_assert(sizeof(CameraAxes) == 64);

class GBufferPass {
  public:
    explicit GBufferPass(gpu::Device& device);
    ~GBufferPass();
    GBufferPass(const GBufferPass&) = delete;
    GBufferPass& operator=(const GBufferPass&) = delete;

    /// Records the drawing, and copies of the result: depths (a float per pixel, near / view depth, 0 where nothing was
    /// drawn) and normals (PointNormal per pixel, zero where nothing was drawn). The images live until the next call.
    void record(gpu::Commands& commands, const SceneBuffers& scene, const CameraAxes& camera, std::uint32_t width,
                std::uint32_t height, const gpu::Buffer& depths, const gpu::Buffer& normals);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace manylights::lab
