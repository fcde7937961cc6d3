#include "lab/techniques/clustered/clustered.h"

namespace manylights::lab {

TechniqueInfo clustered_info() {
    return structure_technique_info("clustered", "a light list per cell of a grid of tiles and depth slices",
                                    StructureKind::lists);
}

std::unique_ptr<Technique> make_clustered(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<StructureTechnique>(device, clustered_info(), StructureKind::lists, options);
}

} // namespace manylights::lab
