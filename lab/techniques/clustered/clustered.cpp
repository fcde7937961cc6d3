#include "lab/techniques/clustered/clustered.h"

#include "lab/gpu/device.h"
#include "lab/scene/error.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kRecordCode[] =
#include "wave_loop_record.comp.inc"
    ;
constexpr std::uint32_t kShadeCode[] =
#include "wave_loop_shade.comp.inc"
    ;

// A lane of a wave touches its own lists, as the cursor's lanes do; what the wave loads is their union, which the
// modelled waves make of any log.
QueryShaders shaders_of(const StructureOptions& options, const gpu::DeviceInfo& device) {
    if (options.loop == ListLoop::lane) return tree_shaders(options);
    if (!device.has_wave_operations)
        throw DeviceError("clustered: option loop=wave: the device " + device.name +
                          " lacks subgroup votes, ballots or arithmetic");
    return {kRecordCode, kShadeCode, cursor_shaders().log};
}

} // namespace

TechniqueInfo clustered_info() {
    return structure_technique_info("clustered", "a light list per cell of a grid of tiles and depth slices",
                                    StructureKind::lists);
}

std::unique_ptr<Technique> make_clustered(gpu::Device& device, const OptionValues& options) {
    const TechniqueInfo info = clustered_info();
    const StructureOptions structure = read_structure_options(info, StructureKind::lists, options);
    return std::make_unique<StructureTechnique>(device, info, structure, shaders_of(structure, device.info()));
}

} // namespace manylights::lab
