#pragma once
// The lights in view scattered into the cells of a grid of tiles and slices, on the device and in order: a pair of cell
// and rank per reference, light after light, sorted by cell. The sort is stable, so that the references of a cell
// ascend by rank, and the same in every run.

#include "lab/techniques/device/depth_order.h"
#include "lab/techniques/device/tile_grid.h"
#include "reference/paper/options.h"

namespace manylights::lab {

/// The cells, and the slices' edges on the device.
struct CellGrid {
    TileGrid tiles;
    std::uint32_t slice_count;
    const gpu::Buffer& slice_edges;

    std::uint64_t cell_count() const { return std::uint64_t{tiles.tile_count()} * slice_count; }
};

class GridReferences {
  public:
    /// name: the technique's, in messages.
    GridReferences(gpu::Device& device, std::string name);

    /// Finds them and waits; the device's time in milliseconds. Throws InputError where there are more than can be
    /// sorted. scope: each_cell where the order is unsorted, and the references are to ascend by depth all the same.
    double find(const CellGrid& grid, const VisibleLights& lights, const DepthOrder& order,
                paper::SortScope scope = paper::SortScope::all_lights);

    std::uint32_t count() const { return count_; }
    /// By reference: the rank of its light.
    const gpu::Buffer& ranks() const { return ranks_.buffer(); }
    /// By cell: how many references it has, and which is its first.
    const gpu::Buffer& counts() const { return cell_counts_.buffer(); }
    const gpu::Buffer& places() const { return cell_places_.buffer(); }
    /// The end of the farthest light's depths, a float.
    const gpu::Buffer& farthest() const { return farthest_.buffer(); }

  private:
    double count_cells(const CellGrid& grid, const VisibleLights& lights, const DepthOrder& order);
    void take_count(std::uint32_t lights);
    double scatter(const CellGrid& grid, const VisibleLights& lights, const DepthOrder& order, paper::SortScope scope);
    void record_pairs(gpu::Commands& commands, const CellGrid& grid, const VisibleLights& lights,
                      const DepthOrder& order);
    void record_depth_sort(gpu::Commands& commands, const DepthOrder& order);

    gpu::Device& device_;
    std::string name_;
    gpu::PrefixSum prefix_sum_;
    gpu::RadixSort sort_;
    gpu::ComputePipeline count_pipeline_, pairs_pipeline_, depths_pipeline_, in_order_pipeline_;
    FittedBuffer light_counts_, light_places_, farthest_, total_, cells_, ranks_, cell_counts_, cell_places_;
    FittedBuffer depths_, numbers_, unordered_cells_, unordered_ranks_; ///< of cells that are sorted on their own
    std::uint32_t count_ = 0;
};

} // namespace manylights::lab
