#pragma once
// A view's points away from the device. Drivers rasterise differently, so what is counted at points that each machine
// draws anew differs as well; the same saved points give the same counts and light sets everywhere.

#include "lab/scene/camera.h"

#include <cstdint>
#include <string>
#include <vector>

namespace manylights::lab {

namespace gpu {
class Device;
}
class PointBuffer;
struct MaterialRecord;

constexpr std::uint32_t kLargestSavedSide = 8192; ///< of the image, pixels
constexpr std::size_t kLongestSavedName = 1024;   ///< of the scene or the camera, bytes

struct SavedPoint {
    std::uint32_t pixel; ///< row by row
    glm::vec3 position;  ///< relative to the camera's position, along the world's axes
    float depth;         ///< view depth
    glm::vec3 normal;    ///< unit length, along the world's axes
    std::uint32_t material;
    bool operator==(const SavedPoint&) const = default;
};

struct SavedPoints {
    std::string scene; ///< what the points are of, without folders
    Camera camera;
    std::uint32_t width = 0, height = 0;
    std::vector<SavedPoint> points; ///< of the pixels that are not sky, ascending
};

/// The field that breaks a rule, and the rule; empty where all is as it should be. A point is held to what the library
/// promises for (docs/conventions.md): it projects into its pixel, in front of the near plane, and its depth is its
/// own.
std::string broken_rule(const SavedPoints& saved);

/// The same for what refers to the scene's materials.
std::string broken_material(const SavedPoints& saved, std::size_t material_count);

SavedPoints save_points(const std::string& scene, const Camera& camera, const PointBuffer& points);

/// On the device as the renderer leaves them: zeros where there is no point. Throws as PointBuffer does.
PointBuffer restore_points(gpu::Device& device, const SavedPoints& saved, const std::vector<MaterialRecord>& materials);

} // namespace manylights::lab
