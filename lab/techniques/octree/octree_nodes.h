#pragma once
// The nodes of an octree over the froxels that have samples.

#include "lab/techniques/octree/occupied_cells.h"
#include "lab/techniques/octree/octree_levels.h"

namespace manylights::lab {

class OctreeNodes {
  public:
    virtual ~OctreeNodes() = default;

    /// Builds them and waits; the device's time in milliseconds.
    virtual double build(const FroxelGrid& grid, const OctreeLevels& levels, const OccupiedCells& cells) = 0;

    /// Numbers that nodes have, and so lists.
    virtual std::uint32_t count() const = 0;
    /// As octree.glsl reads them.
    virtual const gpu::Buffer& nodes() const = 0;
};

/// Eight children of each node that has froxels with samples, from a pool.
std::unique_ptr<OctreeNodes> make_sparse_nodes(gpu::Device& device);
/// Every node of the whole grid has a number.
std::unique_ptr<OctreeNodes> make_dense_nodes(gpu::Device& device);

} // namespace manylights::lab
