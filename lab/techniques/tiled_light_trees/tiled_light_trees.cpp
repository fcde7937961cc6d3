#include "lab/techniques/tiled_light_trees/tiled_light_trees.h"

namespace manylights::lab {

TechniqueInfo tiled_light_trees_info() {
    return structure_technique_info("tiled_light_trees", "a light tree over depth per tile", StructureKind::trees);
}

std::unique_ptr<Technique> make_tiled_light_trees(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<StructureTechnique>(device, tiled_light_trees_info(), StructureKind::trees, options);
}

} // namespace manylights::lab
