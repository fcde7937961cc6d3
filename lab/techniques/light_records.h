#pragma once
// Lights stored once per reference instead of once: what a leaf's or a list's lights are lies side by side, for more
// memory and a longer build. "Duplicated data" of Tiled Light Trees, figure 5.

#include "lab/techniques/light_stream.h"

#include <span>

namespace manylights::lab {

/// What shading reads of a light, in the place of the reference to it: the text of tree_walk.glsl.
struct LightRecord {
    glm::vec4 sphere;
    glm::vec3 color;
    std::uint32_t light;
};
static_assert(sizeof(LightRecord) == 32);

LightRecord light_record(const LightStream& lights, std::uint32_t light);
/// A record per reference, ascending: the target may be mapped memory of the device.
void write_light_records(const LightStream& lights, std::span<const std::uint32_t> references, LightRecord* target);

} // namespace manylights::lab
