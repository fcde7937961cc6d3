#include "lab/techniques/octree/occupied_cells.h"

namespace manylights::lab {

OccupiedCells::OccupiedCells(gpu::Device& device)
    : device_(device), prefix_sum_(device), cells_(device, "froxels with samples"),
      total_(device, "number of froxels with samples") {
    total_.fit(sizeof(std::uint32_t));
}

void OccupiedCells::set_count(std::uint32_t count) {
    count_ = count;
    cells_.fit(std::uint64_t{count} * sizeof(std::uint32_t));
}

} // namespace manylights::lab
