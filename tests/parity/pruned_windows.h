#pragma once
// What tests of depth mode share: windows of the library, what a pruning leaves of them, and what points are handed.

#include "lab/renderer/point_buffer.h"
#include "lab/techniques/depth_windows/depth_pruning.h"
#include "lab/techniques/host_structure.h"

#include <map>
#include <set>
#include <string>

namespace manylights::lab {

/// A structure before and after.
struct Pruned {
    HostStructure whole, left;
    std::string broken; ///< of what is left
    std::uint64_t references;

    std::uint64_t whole_references() const { return whole.references.size() / 2; }
};
Pruned prune(DepthPruning& pruning, gpu::Device& device, const Frame& frame, std::uint32_t tile_size);
Pruned prune(gpu::Device& device, const Frame& frame, std::uint32_t tile_size);

/// References and lights, summed over the points.
struct Kept {
    std::size_t needed = 0; ///< references that the whole structure hands to some point
    std::uint64_t handed = 0, handed_by_whole = 0;
};
/// Fails unless what is left is valid and every point's lights are all there, in the same order. Others may be between
/// them: merged slices are wider than the 256 units of a reference's depths were chosen for.
Kept expect_all_handed(const Pruned& pruned, const std::vector<PointPosition>& points, const std::string& what);

/// Fails unless tiles have tables for more than 8 references only, of three slices or more, and of fewer than 3/4 of
/// their references.
void expect_small_tables(const HostStructure& structure);

/// How many tiles of each kind there are, by what their forms say.
std::map<std::string, int> kinds_of_tiles(const HostStructure& structure);
std::set<std::uint32_t> lights_left(const Pruned& pruned);

} // namespace manylights::lab
