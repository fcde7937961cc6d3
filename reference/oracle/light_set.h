#pragma once
// Brute force: every light is asked whether it affects the point. The truth in tests; nothing here is clever.

#include "reference/oracle/camera.h"

#include <cstdint>
#include <vector>

namespace manylights::oracle {

/// A range above this is taken as this (manylights.h).
inline constexpr float kLargestRange = 1e18f;

/// A light that is not ignored: finite coordinates, and a range that is not NaN and not negative.
bool is_usable(const ManylightsSphere& sphere);

/// Light i of the caller's own array.
ManylightsSphere sphere_at(const ManylightsLights& lights, std::uint32_t index);

struct RelativeLight {
    MlFloat3 center; ///< camera-relative
    float range;
    std::uint32_t index;
};

/// The usable lights relative to a camera position.
std::vector<RelativeLight> relative_lights(const ManylightsLights& lights, const float eye[3]);

/// The lights that affect a point.
struct LightSet {
    std::vector<std::uint32_t> indices; ///< ascending
    std::uint32_t hash_a = 0;           ///< wrapping sum of light_hash_a
    std::uint32_t hash_b = 0;

    void add(std::uint32_t light);
};

LightSet affecting_lights(MlFloat3 point, const std::vector<RelativeLight>& lights);

/// Distance of the point from the light's surface in double precision: negative inside.
double distance_to_surface(MlFloat3 point, const RelativeLight& light);

} // namespace manylights::oracle
