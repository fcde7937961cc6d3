#pragma once
// Which froxels have samples of the view: each once, in ascending order of their numbers. Ways to find them on the
// device, with the same result to the last word.

#include "lab/gpu/prefix_sum.h"
#include "lab/techniques/device/froxel_grid.h"

#include <memory>

namespace manylights::lab {

class OccupiedCells {
  public:
    explicit OccupiedCells(gpu::Device& device);
    virtual ~OccupiedCells() = default;

    /// Finds them and waits; the device's time in milliseconds.
    virtual double find(const Frame& frame, const FroxelGrid& grid) = 0;

    std::uint32_t count() const { return count_; }
    const gpu::Buffer& cells() const { return cells_.buffer(); } ///< a froxel's number each

  protected:
    std::uint32_t total() const { return total_.buffer().download<std::uint32_t>(1).front(); }
    /// Room for so many.
    void set_count(std::uint32_t count);

    gpu::Device& device_;
    gpu::PrefixSum prefix_sum_;
    FittedBuffer cells_, total_;

  private:
    std::uint32_t count_ = 0;
};

/// A bit for each froxel, a workgroup for each tile.
std::unique_ptr<OccupiedCells> make_cells_by_bits(gpu::Device& device);
/// The froxels of all pixels are sorted. is_compacted_first: only those that differ from the pixel's before.
std::unique_ptr<OccupiedCells> make_cells_by_sort(gpu::Device& device, bool is_compacted_first);

} // namespace manylights::lab
