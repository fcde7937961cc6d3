// All techniques: one line each.

#include "lab/scene/error.h"
#include "lab/techniques/brute_force/brute_force.h"
#include "lab/techniques/clustered/clustered.h"
#include "lab/techniques/clustered_samples/clustered_samples.h"
#include "lab/techniques/culling_2_5d/culling_2_5d.h"
#include "lab/techniques/depth_windows/depth_windows.h"
#include "lab/techniques/depth_windows_wave/depth_windows_wave.h"
#include "lab/techniques/exact/exact.h"
#include "lab/techniques/hybrid_light_trees/hybrid_light_trees.h"
#include "lab/techniques/hybrid_lighting/hybrid_lighting.h"
#include "lab/techniques/light_linked_list/light_linked_list.h"
#include "lab/techniques/light_volumes/light_volumes.h"
#include "lab/techniques/octree/octree.h"
#include "lab/techniques/tiled/tiled.h"
#include "lab/techniques/tiled_light_trees/tiled_light_trees.h"
#include "lab/techniques/z_bins/z_bins.h"

namespace manylights::lab {

namespace {

struct Entry {
    TechniqueInfo (*info)();
    std::unique_ptr<Technique> (*make)(gpu::Device& device, const OptionValues& options);
};

constexpr Entry kTechniques[] = {
    {brute_force_info, make_brute_force},
    {exact_info, make_exact},
    {clustered_info, make_clustered},
    {tiled_light_trees_info, make_tiled_light_trees},
    {hybrid_light_trees_info, make_hybrid_light_trees},
    {depth_windows_info, make_depth_windows},
    {depth_windows_wave_info, make_depth_windows_wave},
    {tiled_info, make_tiled},
    {culling_2_5d_info, make_culling_2_5d},
    {clustered_samples_info, make_clustered_samples},
    {z_bins_info, make_z_bins},
    {hybrid_lighting_info, make_hybrid_lighting},
    {light_linked_list_info, make_light_linked_list},
    {light_volumes_info, make_light_volumes},
    {octree_info, make_octree},
};

} // namespace

std::vector<TechniqueInfo> technique_infos() {
    std::vector<TechniqueInfo> infos;
    for (const Entry& entry : kTechniques) infos.push_back(entry.info());
    return infos;
}

std::unique_ptr<Technique> make_technique(gpu::Device& device, const std::string& name, const OptionValues& options) {
    std::string names;
    for (const Entry& entry : kTechniques) {
        const std::string entry_name = entry.info().name;
        if (entry_name == name) return entry.make(device, options);
        names += (names.empty() ? "" : ", ") + entry_name;
    }
    throw InputError("unknown technique '" + name + "'; the techniques are " + names);
}

} // namespace manylights::lab
