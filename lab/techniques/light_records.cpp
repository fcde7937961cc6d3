#include "lab/techniques/light_records.h"

namespace manylights::lab {

LightRecord light_record(const LightStream& lights, std::uint32_t light) {
    return {lights.spheres[light], glm::vec3(lights.colors[light]), light};
}

void write_light_records(const LightStream& lights, std::span<const std::uint32_t> references, LightRecord* target) {
    for (std::size_t i = 0; i < references.size(); ++i) target[i] = light_record(lights, references[i]);
}

} // namespace manylights::lab
