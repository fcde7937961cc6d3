#pragma once
// What the papers vary. "TLT" is O'Donnell and Chajdas, Tiled Light Trees, I3D 2017; "slides" its talk; "demo" the
// program that its authors published. The defaults are the paper's configuration, read exactly.

#include <cstdint>

namespace manylights::paper {

enum class Structure : std::uint32_t {
    clustered, ///< lists per cell of a tile x slice grid: Persson 2013, the paper's baseline (TLT section 4)
    tree,      ///< one light tree per tile (TLT sections 3.1 and 3.2)
    hybrid     ///< per cell a list or a light tree (TLT section 3.3)
};

enum class SliceFormula : std::uint32_t {
    corrected,          ///< the slides' edges: slice_near * (slice_far / slice_near)^(i / (slice_count - 1))
    listing4_as_printed ///< TLT listing 4 to the letter: it divides where it should multiply by slice_count - 1, so
                        ///< that depths from slice_near on share one slice; exact all the same, only slow
};

/// Which cells of its box a light goes to. Not of the papers: it makes of their grid a rival as good as it can be.
enum class CellTest : std::uint32_t {
    box,  ///< all of them (TLT section 4.1)
    tight ///< those that its sphere meets: tight.h
};

/// When a cell of the hybrid gets a tree (TLT section 3.3, listing 2, whose `cell.radius` is not defined).
enum class Heuristic : std::uint32_t {
    clipped_half_extent, ///< mean depth overlap of light and cell < half of the cell's depth extent
    diameter_extent,     ///< mean light diameter < the cell's depth extent: the demo's default
    clipped_extent,      ///< mean depth overlap < the cell's whole depth extent
    expected_cost,       ///< modelled cost of the tree, for a depth uniform in the cell, < that of the list
    always_tree,         ///< every cell with more lights than fit one leaf
    always_list          ///< none: the hybrid then tests what `clustered` tests
};

/// What lights are sorted by (TLT section 3.2 sorts by the distance to the camera plane, of the centre).
enum class SortKey : std::uint32_t { center_depth, near_depth };

/// Where lights are sorted (TLT section 3.2, which found the first to be cheaper where lights overlap many cells).
enum class SortScope : std::uint32_t {
    all_lights, ///< once, before they are binned in that order
    each_cell   ///< the references of each cell, by the middle or the near end of their depth range
};

/// How trees are made (TLT section 3.2).
enum class TreeBuild : std::uint32_t {
    bottom_up, ///< perfect binary trees of even leaves, in O(n)
    top_down   ///< splits where the modelled cost is least, in O(n log n); not padded
};

/// Where the walk through a tile's tree begins; of Structure::tree.
enum class TreeEntry : std::uint32_t {
    root,
    per_slice ///< the smallest subtree with all leaves that depths of the slice can hit (slides, future work)
};

/// Depth bounds of a list's single node (TLT section 3.4 iterates over a list without asking for its bounds).
enum class ListBounds : std::uint32_t { infinite, of_lights };

struct Options {
    Structure structure = Structure::hybrid;
    std::uint32_t tile_px = 48;     ///< TLT section 4.2, figure 6; at least 8
    std::uint32_t slice_count = 16; ///< TLT section 4; [1, 128]; trees have them only with TreeEntry::per_slice
    float slice_near = 5.0f;        ///< end of the first slice, > 0 (TLT section 4)
    float slice_far = 500.0f;       ///< > slice_near: "based on the scene extents" (TLT section 4)
    std::uint32_t leaf_size = 4;    ///< "several light sources" (TLT section 3.2); [1, 65535]
    SliceFormula slice_formula = SliceFormula::corrected;
    Heuristic heuristic = Heuristic::clipped_half_extent;
    SortKey sort_key = SortKey::center_depth;
    SortScope sort_scope = SortScope::all_lights;
    TreeBuild tree_build = TreeBuild::bottom_up;
    TreeEntry tree_entry = TreeEntry::root;
    ListBounds list_bounds = ListBounds::infinite;
    CellTest cell_test = CellTest::box;
    bool time_stages = false; ///< fill Buffers::times
};

} // namespace manylights::paper
