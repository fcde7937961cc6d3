#pragma once
// The options that the structures of the library's format share.

#include "lab/techniques/options.h"
#include "reference/paper/options.h"

namespace manylights::lab {

enum class StructureKind { lists, trees, hybrid, windows };
enum class ProducerKind { library, paper };
/// Who walks lists: each lane its own, or the lanes of a wave the union of theirs.
enum class ListLoop { lane, wave };

struct StructureOptions {
    StructureKind kind = StructureKind::hybrid;
    ProducerKind producer = ProducerKind::library;
    bool on_device = false;       ///< instead of a producer
    std::uint32_t tile_size = 48; ///< 0: the producer's choice, of windows only
    std::uint32_t slice_count = 16;
    std::uint32_t leaf_size = 4;
    std::optional<float> slice_near, slice_far;                         ///< empty: by the scene, see slice_range
    paper::Heuristic heuristic = paper::Heuristic::clipped_half_extent; ///< these seven: not with the library
    paper::SliceFormula slice_formula = paper::SliceFormula::corrected;
    paper::SortKey sort_key = paper::SortKey::center_depth;
    paper::SortScope sort_scope = paper::SortScope::all_lights;
    paper::TreeBuild tree_build = paper::TreeBuild::bottom_up;
    paper::TreeEntry tree_entry = paper::TreeEntry::root;
    paper::ListBounds list_bounds = paper::ListBounds::infinite;
    paper::CellTest cell_test = paper::CellTest::box; ///< these two: of lists only, and tight and wave the same
    ListLoop loop = ListLoop::lane;
    bool has_three_paths = false; ///< these three: how tree_walk.glsl reads the structure
    bool copies_trees = false;
    bool has_records = false; ///< lights in the place of the references to them: light_records.h

    bool needs_tree_walk() const { return has_three_paths || copies_trees || has_records; }
};

std::vector<OptionInfo> structure_option_infos(StructureKind kind);

/// Throws InputError.
StructureOptions read_structure_options(const TechniqueInfo& info, StructureKind kind, const OptionValues& values);

struct SliceRange {
    float near_edge, far_edge;
};
/// The exponential slices' range: far is the scene's view distance, near 5 (O'Donnell and Chajdas, section 4) or a
/// tenth of far where that is less. Throws InputError where near is not below far.
SliceRange slice_range(const StructureOptions& options, const Scene& scene);

} // namespace manylights::lab
