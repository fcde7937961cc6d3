#pragma once
// A scene: triangles with plain physically based materials, named cameras, a camera path, and the boxes that light
// distributions fill. World space, right-handed, y up.

#include "lab/scene/camera.h"
#include "lab/scene/lights.h"

#include <cstdint>
#include <string>
#include <vector>

namespace manylights::lab {

struct Material {
    glm::vec3 base_color{0.8f}; ///< linear, [0, 1]
    float roughness = 0.8f;     ///< [0, 1]
    float metallic = 0.0f;      ///< [0, 1]
    glm::vec3 emissive{0.0f};   ///< linear radiance
};

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal; ///< unit length
    std::uint32_t material;
};

struct Box {
    glm::vec3 lower{0.0f}, upper{0.0f};
};

/// How the distribution `surface` treats the triangles of one material.
struct SurfaceRule {
    float density = 1.0f;                           ///< lights per area, relative to the other materials
    float offset_lower = 0.0f, offset_upper = 0.0f; ///< distance of a light from its triangle, uniform in between
};

/// The unit radii of `--radius auto`: many small lights, few large ones, uniform between the bounds.
struct RadiusTable {
    float small_lower = 2.0f, small_upper = 8.0f;
    float large_lower = 30.0f, large_upper = 80.0f;
    float large_share = 0.0005f; ///< of all lights
    float scale_cap = 1.0f;      ///< `auto` never scales by more than this
};

struct Scene {
    std::string name; ///< "canyon", or the file's path
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices; ///< three per triangle
    std::vector<Material> materials;
    std::vector<Camera> cameras;         ///< named; at least one; the first is the default
    std::vector<Camera> path;            ///< the 16 fixed frames for comparisons
    Box bounds;                          ///< of all triangles
    Box light_box;                       ///< that the volume distribution fills
    std::string distribution = "volume"; ///< of lights, where none is asked for
    float view_extent = 500.0f;          ///< slice_far of the structures: the scene's view distance
    RadiusTable radii;
    std::vector<SurfaceRule> surface_rules; ///< one per material; empty: the same density everywhere, offset by radius
    float crowding_radius = 0.0f; ///< surface lights thin out as 1 / (1 + (d / crowding_radius)^2) with the horizontal
                                  ///< distance d from the centre of light_box; 0: not at all
    std::vector<Light> lights;    ///< the scene's own (glTF KHR_lights_punctual), world space
};

/// How much of a built-in scene is built: `full` for figures and pictures, `low` stays under 20,000 triangles.
enum class Detail { low, full };

struct SceneInfo {
    std::string name, summary;
};
std::vector<SceneInfo> builtin_scenes();

/// A built-in scene's name, or the path of a .glb or .gltf file. Throws InputError.
Scene load_scene(const std::string& name_or_path, Detail detail = Detail::full);

/// "path:T" with T in [0, 1), or the name of a camera, or empty for the default one. Throws InputError naming the
/// choices.
Camera find_camera(const Scene& scene, const std::string& selector);

/// World-space points that the camera sees, one per pixel that is not sky, row by row, from a software depth buffer;
/// the same on every machine. The normal is that of the triangle's first corner, turned to the camera.
struct SurfacePoint {
    glm::vec3 position, normal;
    std::uint32_t material;
};
std::vector<SurfacePoint> visible_points(const Scene& scene, const Camera& camera, std::uint32_t width,
                                         std::uint32_t height);

} // namespace manylights::lab
