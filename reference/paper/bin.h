#pragma once
// Scattering lights into cells: count, prefix sum, fill (TLT section 4.1: half of the build's time). The boxes, most of
// them of a few cells, are walked once and written out as a stream of (cell, light), because their loops end
// unpredictably; count and fill then read the stream straight through.

#include "reference/paper/bounds.h"
#include "reference/paper/flat_array.h"

#include <manylights/format.h>

namespace manylights::paper {

/// One reference on its way to its cell: `light` is the place of its CellLight.
struct Scatter {
    std::uint32_t cell, light;
};

/// Room that write_scatter may use beyond the number of references.
constexpr std::size_t kScatterPadding = 3;

/// Lists the references of the lights, light after light.
void write_scatter(const CellBox* boxes, std::size_t light_count, const Grid& grid, Scatter* scatter);

/// Counts the references of each cell, and places the cells one after the other from `first_reference` on. `cursors`
/// are the cells' firsts, too.
void place_cells(const Scatter* scatter, std::size_t count, std::uint32_t first_reference, MlCell* cells,
                 std::uint32_t* cursors, std::size_t cell_count);

/// Writes to each cell's references the places of its lights, ascending, or their indices. Moves the cursors.
void fill_places(const Scatter* scatter, std::size_t count, std::uint32_t* cursors, std::uint32_t* references);
void fill_indices(const Scatter* scatter, std::size_t count, const CellLight* lights, std::uint32_t* cursors,
                  std::uint32_t* references);

} // namespace manylights::paper
