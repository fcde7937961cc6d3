#include "lab/scene/light_placement.h"

#include "lab/scene/error.h"
#include "lab/scene/random.h"
#include "lab/scene/truncated_normal.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace manylights::lab {
namespace {

constexpr std::uint32_t kGroups = 1000, kLargest = 1000;

/// Channels 0 to 7 of a light's random numbers are its position's; lights.cpp uses those from 8 on. Group centres have
/// channels of their own.
constexpr std::uint32_t kGroupChannel = 100;

glm::vec3 uniform_in(const Box& box, std::uint32_t seed, std::uint32_t i, std::uint32_t channel) {
    return {random_between(seed, i, channel, box.lower.x, box.upper.x),
            random_between(seed, i, channel + 1, box.lower.y, box.upper.y),
            random_between(seed, i, channel + 2, box.lower.z, box.upper.z)};
}

float length(const glm::vec3& v) { return std::sqrt(glm::dot(v, v)); }

struct Patch {
    glm::vec3 a, ab, ac, normal; ///< normal: unit length, on the side of the vertex normals
    float area, offset_lower, offset_upper;
};

/// Triangles with a running sum of their weights, for choosing one in proportion.
class PatchTable {
  public:
    void add(const Patch& patch, double weight) {
        total_ += weight;
        patches_.push_back(patch);
        sums_.push_back(total_);
    }

    void require_some(const Scene& scene, const char* distribution) const {
        if (total_ > 0.0) return;
        throw InputError(std::string("distribution \"") + distribution + "\": scene \"" + scene.name +
                         "\" has no triangle with an area");
    }

    const Patch& choose(double u) const {
        const auto found = std::upper_bound(sums_.begin(), sums_.end(), u * total_);
        return patches_[std::min(std::size_t(found - sums_.begin()), patches_.size() - 1)];
    }

    void keep_largest(std::size_t count) {
        std::stable_sort(patches_.begin(), patches_.end(),
                         [](const Patch& a, const Patch& b) { return a.area > b.area; });
        std::vector<Patch> largest(patches_.begin(),
                                   patches_.begin() + std::ptrdiff_t(std::min(count, patches_.size())));
        *this = PatchTable();
        for (const Patch& patch : largest) add(patch, double(patch.area));
    }

  private:
    std::vector<Patch> patches_;
    std::vector<double> sums_;
    double total_ = 0.0;
};

/// Uniform on the patch, by the square root that folds the unit square onto a triangle, then off along the normal.
glm::vec3 point_near(const Patch& patch, std::uint32_t seed, std::uint32_t i, float offset) {
    const float root = std::sqrt(random_unit(seed, i, 1)), v = random_unit(seed, i, 2);
    return patch.a + patch.ab * (root * (1.0f - v)) + patch.ac * (root * v) + patch.normal * offset;
}

double crowding(const Scene& scene, const Patch& patch) {
    if (!(scene.crowding_radius > 0.0f)) return 1.0;
    const glm::vec3 from =
        patch.a + (patch.ab + patch.ac) / 3.0f - 0.5f * (scene.light_box.lower + scene.light_box.upper);
    const double x = from.x, z = from.z, radius = scene.crowding_radius;
    return 1.0 / (1.0 + (x * x + z * z) / (radius * radius));
}

PatchTable all_patches(const Scene& scene) {
    PatchTable table;
    for (std::size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
        const Vertex &a = scene.vertices[scene.indices[i]], &b = scene.vertices[scene.indices[i + 1]],
                     &c = scene.vertices[scene.indices[i + 2]];
        Patch patch{a.position, b.position - a.position, c.position - a.position, {}, 0.0f, 0.0f, 0.0f};
        const glm::vec3 cross = glm::cross(patch.ab, patch.ac);
        const float doubled_area = length(cross);
        if (!(doubled_area > 0.0f) || !(doubled_area < 1e30f)) continue;
        const bool inward = glm::dot(cross, a.normal + b.normal + c.normal) < 0.0f;
        patch.normal = cross / (inward ? -doubled_area : doubled_area);
        patch.area = 0.5f * doubled_area;
        double density = 1.0;
        if (!scene.surface_rules.empty()) {
            const SurfaceRule& rule = scene.surface_rules[a.material];
            patch.offset_lower = rule.offset_lower;
            patch.offset_upper = rule.offset_upper;
            density = double(rule.density);
        }
        table.add(patch, double(patch.area) * density * crowding(scene, patch));
    }
    return table;
}

} // namespace

Placement place_in_volume(const Scene& scene) {
    return [box = scene.light_box](std::uint32_t seed, std::uint32_t i, float) { return uniform_in(box, seed, i, 0); };
}

Placement place_on_surface(const Scene& scene, float offset_share) {
    const auto table = std::make_shared<const PatchTable>(all_patches(scene));
    table->require_some(scene, "surface");
    const bool ruled = !scene.surface_rules.empty();
    return [table, ruled, offset_share](std::uint32_t seed, std::uint32_t i, float radius) {
        const Patch& patch = table->choose(random_unit_double(seed, i, 0));
        const float offset =
            ruled ? random_between(seed, i, 3, patch.offset_lower, patch.offset_upper) : offset_share * radius;
        return point_near(patch, seed, i, offset);
    };
}

Placement place_on_largest(const Scene& scene, float offset_share) {
    PatchTable all = all_patches(scene);
    all.require_some(scene, "surface-largest");
    all.keep_largest(kLargest);
    const auto table = std::make_shared<const PatchTable>(std::move(all));
    return [table, offset_share](std::uint32_t seed, std::uint32_t i, float radius) {
        const Patch& patch = table->choose(random_unit_double(seed, i, 0));
        return point_near(patch, seed, i, random_unit(seed, i, 3) * offset_share * radius);
    };
}

Placement place_in_groups(const Scene& scene) {
    const float reach = 0.015f * length(scene.light_box.upper - scene.light_box.lower);
    return [box = scene.light_box, reach](std::uint32_t seed, std::uint32_t i, float) {
        glm::vec3 position = uniform_in(box, seed, i % kGroups, kGroupChannel);
        for (int axis = 0; axis < 3; ++axis) {
            const double u = random_unit_double(seed, i, std::uint32_t(axis));
            position[axis] += float(0.5 * double(reach) * truncated_normal(u));
        }
        return position;
    };
}

Placement place_in_view(const Camera& camera, float scale) {
    return [basis = camera_basis(camera, 16, 9), eye = camera.position, scale](std::uint32_t seed, std::uint32_t i,
                                                                               float) {
        const float depth = scale * random_between(seed, i, 0, 1.0f, 201.0f);
        const float x = depth * basis.tan_half_x * random_between(seed, i, 1, -1.0f, 1.0f);
        const float y = depth * basis.tan_half_y * random_between(seed, i, 2, -1.0f, 1.0f);
        return eye + basis.right * x + basis.up * y + basis.forward * depth;
    };
}

} // namespace manylights::lab
