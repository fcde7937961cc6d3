#pragma once
// The lights of a frame as the device sees them: the membership stream (camera-relative centre, range) and the colours.

#include "lab/techniques/technique.h"

#include <glm/glm.hpp>

namespace manylights::lab {

/// Indexed by light index, with one padding light behind the last that affects nothing: what a light index is replaced
/// by when a reference is taken out for a test.
struct LightStream {
    std::vector<glm::vec4> spheres; ///< world position minus camera position, each coordinate rounded once; range
    std::vector<glm::vec4> colors;  ///< linear radiant intensity; w is 0

    std::uint32_t light_count() const { return static_cast<std::uint32_t>(spheres.size() - 1); }
};

/// The frame's lights as the library's interface takes them, read in place.
ManylightsLights public_lights(const Frame& frame);

/// A light that the library ignores (non-finite, or a negative range) has the range 0 here, which affects nothing under
/// the strict rule. A negative range left in place would pass: the rule squares it.
LightStream make_light_stream(const Frame& frame);

/// The lights that contain a camera-relative point, ascending: the rule itself, one light after the other.
std::vector<std::uint32_t> affecting_lights(const LightStream& lights, const glm::vec3& point);

} // namespace manylights::lab
