#include "lab/techniques/depth_windows/depth_windows.h"

namespace manylights::lab {

TechniqueInfo depth_windows_info() {
    return structure_technique_info(
        "depth_windows", "per tile, windows over its lights ordered by depth, each with its depths and pixels",
        StructureKind::windows);
}

std::unique_ptr<Technique> make_depth_windows(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<StructureTechnique>(device, depth_windows_info(), StructureKind::windows, options);
}

} // namespace manylights::lab
