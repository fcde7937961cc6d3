#pragma once
// Adds flat-shaded primitives to a scene.

#include "lab/scene/scene.h"

namespace manylights::lab {

/// Sides of a box, to leave out those that nobody can see.
enum BoxSides : unsigned {
    kSideNegativeX = 1,
    kSidePositiveX = 2,
    kSideNegativeZ = 4,
    kSidePositiveZ = 8,
    kSideTop = 16,
    kSideBottom = 32,
    kSidesAround = 15,
    kSidesAll = 63,
    kSidesStanding = kSidesAround | kSideTop
};

class MeshBuilder {
  public:
    explicit MeshBuilder(Scene& scene) : scene_(scene) {}

    /// Number of the material, for the calls below.
    std::uint32_t material(glm::vec3 base_color, float roughness = 0.85f, float metallic = 0.0f);

    /// Counter-clockwise seen from outside. Triangles without area are left out.
    void triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c, std::uint32_t material);
    void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, std::uint32_t material);

    void box(glm::vec3 lower, glm::vec3 upper, unsigned sides, std::uint32_t material);
    void box(glm::vec3 lower, glm::vec3 upper, unsigned sides, std::uint32_t side_material, std::uint32_t top_material);

    /// A whole box whose upper edges on the given sides are cut at 45 degrees, `bevel` wide.
    void bevelled_box(glm::vec3 lower, glm::vec3 upper, float bevel, unsigned bevelled, std::uint32_t side_material,
                      std::uint32_t top_material);

    /// A standing prism with a nearly regular polygon as its base, narrowing from radius to top_radius (0: a cone).
    void tower(glm::vec3 base_center, float radius, float top_radius, float height, unsigned corners, bool top,
               std::uint32_t material); // corners: a multiple of 4

    /// A roof with a ridge along x or z over [lower, upper] (y: eaves to ridge).
    void gabled_roof(glm::vec3 lower, glm::vec3 upper, bool ridge_along_x, std::uint32_t roof_material,
                     std::uint32_t gable_material);

  private:
    Scene& scene_;
};

/// Sets bounds from the triangles.
void set_bounds(Scene& scene);

Camera look_at(const char* name, glm::vec3 from, glm::vec3 to);

} // namespace manylights::lab
