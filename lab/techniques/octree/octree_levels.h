#pragma once
// The levels of an octree over froxels: octree.glsl has what shaders ask of them.

#include "lab/techniques/device/froxel_grid.h"

namespace manylights::lab {

class OctreeLevels {
  public:
    static constexpr std::uint32_t kMost = 14; ///< 8,192 tiles along an axis are the most

    explicit OctreeLevels(gpu::Device& device) : buffer_(device, "levels of an octree") {}

    /// As many as the longest axis needs. Throws InputError where a dense octree has more nodes than can be counted.
    void lay_out(const FroxelGrid& grid, bool is_sparse);

    std::uint32_t count() const { return count_; }
    /// Were every froxel there.
    std::uint64_t nodes_of(std::uint32_t level) const { return first_nodes_[level + 1] - first_nodes_[level]; }
    /// Of all levels together.
    std::uint64_t all_nodes() const { return first_nodes_[count_]; }
    const gpu::Buffer& buffer() const { return buffer_.buffer(); }

  private:
    FittedBuffer buffer_;
    std::uint32_t count_ = 0;
    std::uint64_t first_nodes_[kMost + 1]{}; ///< of each level, and behind the last one
};

} // namespace manylights::lab
