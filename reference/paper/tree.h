#pragma once
// Light trees: binary trees over the depth ranges of a cell's lights. Complete ones are built bottom-up, leaves first,
// and turned depth first by tables (TLT sections 3.1 and 3.2, slides "Breadth-first to depth-first tree conversion");
// the alternative, top-down, chooses its splits freely and is depth first at once.

#include "reference/paper/bin.h"
#include "reference/paper/options.h"

#include <cstdint>
#include <vector>

namespace manylights::paper {

/// A tree has at most 2^14 leaves: its root's skip count, 2^15 - 1, then fits 15 bits.
constexpr std::uint32_t kMaxTreeLevels = 15;
constexpr std::uint32_t kMaxTreeLeaves = 1u << (kMaxTreeLevels - 1);

/// For each node of a tree of `levels` levels, depth first: its breadth-first place, and its skip count.
struct DepthFirstEntry {
    std::uint16_t breadth_first, skip;
};
std::vector<DepthFirstEntry> depth_first_table(std::uint32_t levels);

struct DepthRange {
    float min, max;
};

/// The depths of a slice that the heuristics assume occupied.
struct SliceExtent {
    float min, max;
};

/// References of one cell.
struct CellLights {
    std::uint32_t first, count;
    const DepthRange* ranges; ///< of its first reference
};

/// Listing 2 and its variants: does the cell get a tree? expected_cost is decided by TreeBuilder.
bool prefers_tree(Heuristic heuristic, const CellLights& lights, SliceExtent extent);

/// The nodes that a walk in a slice's depths, [extent.min, extent.max), has to go through, of a tile's nodes.
MlCell entry_in_slice(const MlNode* nodes, const MlCell& tile, SliceExtent extent);

class TreeBuilder {
  public:
    TreeBuilder();

    /// Builds cells one after the other into scratch memory; a cell becomes a run of trees, a list
    /// being a run of leaves. Returns its number of nodes.
    std::uint32_t build_cell(const CellLights& lights, SliceExtent extent, const Options& options);
    bool built_tree() const { return built_tree_; } ///< of the last cell: not a list

    std::uint32_t node_count() const { return node_count_; } ///< of all cells since the last pack
    /// Writes them depth first and starts anew.
    void pack(MlNode* nodes);
    void clear(); ///< forgets cells that were not packed, as after an exception

  private:
    struct Tree {
        std::uint32_t first_node, node_count;
        std::uint32_t levels; ///< 0: depth first already
    };

    void add_list(const CellLights& lights, const Options& options);
    void add_trees(const CellLights& lights, SliceExtent extent, const Options& options);
    void add_tree_bottom_up(const CellLights& lights, std::uint32_t leaf_size);
    void add_tree_top_down(const CellLights& lights, SliceExtent extent, std::uint32_t leaf_size);
    void add_subtree(const CellLights& lights, SliceExtent extent, std::uint32_t leaf_size);
    std::uint32_t best_split(const CellLights& lights, SliceExtent extent);
    float expected_cost(std::size_t first_tree, SliceExtent extent) const;

    std::vector<DepthFirstEntry> tables_[kMaxTreeLevels + 1];
    FlatArray<MlNode> scratch_;
    FlatArray<float> costs_; ///< of the lights before a split
    std::uint32_t node_count_ = 0;
    std::vector<Tree> trees_;
    bool built_tree_ = false;
};

} // namespace manylights::paper
