#pragma once
// Where light i of each distribution stands: a function of (seed, i, unit radius) and the scene.

#include "lab/scene/scene.h"

#include <functional>

namespace manylights::lab {

/// Position of light i; `radius` is its radius before any common factor.
using Placement = std::function<glm::vec3(std::uint32_t seed, std::uint32_t i, float radius)>;

/// Uniform in the light box.
Placement place_in_volume(const Scene& scene);

/// Near the triangles, chosen by area (times the density of the scene's surface rules), off along the normal: by the
/// rule's own offset where the scene has rules, else by offset_share * radius.
Placement place_on_surface(const Scene& scene, float offset_share);

/// Near the 1,000 largest triangles, chosen by area, off along the normal by up to offset_share * radius.
Placement place_on_largest(const Scene& scene, float offset_share);

/// 1,000 groups around centres uniform in the light box; light i belongs to group i modulo 1,000 and scatters by a
/// normal distribution of standard deviation R / 2 per axis, cut at R, with R = 1.5% of the box's diagonal.
Placement place_in_groups(const Scene& scene);

/// Uniform in view depth 1 to 201 and over the frustum's cross-section there, times `scale`.
Placement place_in_view(const Camera& camera, float scale);

} // namespace manylights::lab
