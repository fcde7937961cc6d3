#pragma once
// The CPU pipeline of Tiled Light Trees (O'Donnell and Chajdas, I3D 2017), scalar, one thread, array-of-structures
// input: the baseline of benchmarks, with the switches that the papers vary.
//
//     cull -> sort by depth -> bounds -> bin (count, prefix sum, fill) -> trees, breadth first -> pack, depth first
//
// The result is the same format that the library writes (manylights/format.h), read by the same query, and as exact:
// the promise of manylights.h holds. All memory is kept between frames.

#include "reference/paper/options.h"
#include "reference/paper/radix_sort.h"
#include "reference/paper/slices.h"
#include "reference/paper/tight.h"
#include "reference/paper/tree.h"

#include <manylights/format.h>
#include <manylights/manylights.h>

#include <cstdint>
#include <span>
#include <vector>

namespace manylights::paper {

/// Milliseconds per stage, summed over the views.
struct StageTimes {
    double cull = 0, sort = 0, bounds = 0, bin = 0, tree = 0, pack = 0;
};

/// One frame. Belongs to the pipeline, valid until its next build.
struct Buffers {
    std::span<const MlView> views;
    std::span<const float> slice_edges; ///< slice_count + 1, one table for all views
    std::span<const MlCell> cells;
    std::span<const MlNode> nodes;
    std::span<const std::uint32_t> references;

    std::uint64_t visible_lights = 0; ///< after culling, summed over the views
    std::uint64_t ignored_lights = 0; ///< non-finite or negative
    std::uint64_t list_cells = 0, tree_cells = 0;
    StageTimes times; ///< zero unless Options::time_stages
};

class PaperPipeline {
  public:
    /// Throws std::invalid_argument for options or a camera outside of the rules, std::length_error for more than 2^32
    /// - 1 references or cells.
    const Buffers& build(std::span<const ManylightsView> views, const ManylightsLights& lights, const Options& options);

  private:
    class StageClock;

    void build_view(const ManylightsView& view, const ManylightsLights& lights, const Options& options,
                    StageClock& clock);
    void place_view(const Camera& camera, const Grid& grid, const Options& options);
    void sort_lights(std::uint32_t count, const Options& options);
    void sort_cells(const MlCell* cells, std::uint32_t cell_count, SortKey key);
    void bound_lights(const Camera& camera, const Grid& grid, std::uint32_t count, const Options& options);
    void scatter_tight(const Camera& camera, const Grid& grid);
    void scatter_boxes(const Grid& grid);
    void bin_lights(MlCell* cells, std::uint32_t cell_count, bool as_indices);
    CellLights take_cell(const MlCell& cell);
    void build_trees(const Camera& camera, const Options& options, MlCell* cells, StageClock& clock);
    void enter_slices(MlCell* cells);
    SliceExtent slice_extent(const Camera& camera, const Options& options, std::uint32_t slice) const;

    SliceTable slices_;
    SliceTable entry_slices_; ///< of TreeEntry::per_slice, whose trees are the whole tile's
    FlatArray<CulledLight> culled_;
    RadixSort sort_;
    const SortPair* order_ = nullptr;
    FlatArray<CellBox> boxes_;
    FlatArray<CellLight> cell_lights_;
    std::uint32_t bounded_count_ = 0;
    float farthest_ = 0.0f;           ///< end of the farthest light's depth range
    std::uint64_t scatter_count_ = 0; ///< cells of all boxes; the tight test leaves fewer
    FlatArray<Scatter> scatter_;
    FlatArray<CulledLight> bounded_; ///< of the boxes, for the tight test
    TightTest tight_;
    FlatArray<std::uint32_t> cursors_;
    FlatArray<DepthRange> ranges_; ///< of one cell's lights
    TreeBuilder tree_builder_;

    std::vector<MlView> views_;
    FlatArray<MlCell> cells_;
    FlatArray<MlNode> nodes_;
    FlatArray<std::uint32_t> references_;
    std::uint64_t cell_count_ = 0, node_count_ = 0, reference_count_ = 0;
    Buffers buffers_;
};

} // namespace manylights::paper
