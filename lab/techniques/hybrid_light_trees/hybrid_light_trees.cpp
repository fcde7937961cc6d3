#include "lab/techniques/hybrid_light_trees/hybrid_light_trees.h"

namespace manylights::lab {

TechniqueInfo hybrid_light_trees_info() {
    return structure_technique_info("hybrid_light_trees",
                                    "a grid of tiles and depth slices, a list or a light tree per cell",
                                    StructureKind::hybrid);
}

std::unique_ptr<Technique> make_hybrid_light_trees(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<StructureTechnique>(device, hybrid_light_trees_info(), StructureKind::hybrid, options);
}

} // namespace manylights::lab
