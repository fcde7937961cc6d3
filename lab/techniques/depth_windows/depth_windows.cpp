#include "lab/techniques/depth_windows/depth_windows.h"

#include "lab/techniques/depth_windows/depth_pruning.h"

namespace manylights::lab {

namespace {

constexpr const char* kDepth[] = {"off", "on"};

TechniqueInfo info_with_depth() {
    TechniqueInfo info = depth_windows_info();
    info.needs_depth = true;
    info.serves_translucent = info.serves_air = false;
    return info;
}

class PrunedDepthWindows : public StructureTechnique {
  public:
    PrunedDepthWindows(gpu::Device& device, const OptionValues& options)
        : StructureTechnique(device, info_with_depth(), StructureKind::windows, options), pruning_(device) {}

  protected:
    BuiltStructure refine(const Frame& frame, const BuiltStructure& built) override {
        const BuiltStructure pruned = pruning_.prune(frame.points, built);
        add_stage("depth", pruning_.milliseconds());
        return pruned;
    }

  private:
    DepthPruning pruning_;
};

} // namespace

TechniqueInfo depth_windows_info() {
    TechniqueInfo info = structure_technique_info(
        "depth_windows", "per tile, windows over its lights ordered by depth, each with its depths and pixels",
        StructureKind::windows);
    info.options.push_back({"depth", "keep on the device only what the points of the depth buffer need",
                            "off (default), or on: serves surfaces alone"});
    return info;
}

std::unique_ptr<Technique> make_depth_windows(gpu::Device& device, const OptionValues& options) {
    const bool has_depth = OptionReader(depth_windows_info(), options).choice("depth", kDepth) != 0;
    if (has_depth) return std::make_unique<PrunedDepthWindows>(device, options);
    return std::make_unique<StructureTechnique>(device, depth_windows_info(), StructureKind::windows, options);
}

} // namespace manylights::lab
