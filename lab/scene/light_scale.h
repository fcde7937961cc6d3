#pragma once

#include "lab/scene/scene.h"

#include <span>

namespace manylights::lab {

/// The factor for all radii with which `wanted` lights affect a point on average, at most `cap`. Points and lights in
/// world space.
float find_radius_scale(std::span<const glm::vec3> points, std::span<const Light> lights, double wanted, float cap);

} // namespace manylights::lab
