#pragma once
// Which cells hold a tree, and where each cell's nodes begin. Decided once, in plan; write follows it.

#include "src/build/bin.h"
#include "src/build/cull.h"
#include "src/build/settings.h"
#include "src/build/slices.h"

#include <cstdint>

namespace manylights::detail {

struct CellNodes {
    Array<std::uint64_t> offsets; // cell count + 1
    Array<std::uint8_t> is_tree;
    std::uint32_t largest_tree_leaves = 0; // of one tree
    std::uint64_t empty_cells, list_cells, tree_cells;
};

// Does a tree serve this cell better than a list? The mean over its lights of the depth range that lies in the cell
// is compared with half of the cell's depth.
bool prefers_tree(const VisibleLight* sorted, const std::uint32_t* ranks, std::uint32_t count, float cell_near,
                  float cell_far);

[[nodiscard]] bool decide_cells(const Settings& settings, const Slices& slices, const Grid* grids, const View* views,
                                std::uint32_t grid_count, const VisibleLight* sorted, const Bins& bins,
                                CellNodes& nodes);

} // namespace manylights::detail
