#pragma once
// The points of a view, one per pixel, on the device: what every technique shades.

#include "lab/gpu/buffer.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace manylights::lab {

/// One pixel's point in the device's buffers: two vec4 in two arrays, row by row.
struct PointPosition {
    glm::vec3 position; ///< relative to the camera's position, along the world's axes
    float depth;        ///< view depth; 0: sky, there is no point
};
struct PointNormal {
    glm::vec3 normal; ///< unit length, along the world's axes, towards the camera
    std::uint32_t material;
};
static_assert(sizeof(PointPosition) == 16 && sizeof(PointNormal) == 16);

/// A material as shading.glsl reads it.
struct MaterialRecord {
    glm::vec3 base_color;
    float roughness;
    glm::vec3 emissive;
    float metallic;
};
static_assert(sizeof(MaterialRecord) == 32);

class PointBuffer {
  public:
    /// An image without any point yet (contents undefined). Throws InputError where a side is zero, DeviceError where
    /// the image is too large for one buffer.
    PointBuffer(gpu::Device& device, std::uint32_t width, std::uint32_t height,
                const std::vector<MaterialRecord>& materials);

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    const gpu::Buffer& positions() const { return positions_; } ///< PointPosition per pixel
    const gpu::Buffer& normals() const { return normals_; }     ///< PointNormal per pixel
    const gpu::Buffer& materials() const { return materials_; } ///< MaterialRecord each, at least one
    gpu::Buffer& positions() { return positions_; }
    gpu::Buffer& normals() { return normals_; }

    std::vector<PointPosition> download_positions() const { return positions_.download<PointPosition>(); }
    std::vector<PointNormal> download_normals() const { return normals_.download<PointNormal>(); }

  private:
    std::uint32_t width_, height_;
    gpu::Buffer positions_, normals_, materials_;
};

} // namespace manylights::lab
