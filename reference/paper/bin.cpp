#include "reference/paper/bin.h"

#include <algorithm>

namespace manylights::paper {
// Four columns are written at a time, the surplus is overwritten by what follows: one loop over rows and slices, and
// for most lights no second one over columns.
void write_scatter(const CellBox* boxes, std::size_t light_count, const Grid& grid, Scatter* scatter) {
    const std::uint32_t slice_step = grid.tiles_x * grid.tiles_y;
    for (std::uint32_t i = 0; i < light_count; ++i) {
        const CellBox& box = boxes[i];
        const std::uint32_t columns = box.columns, rows = box.rows, row_count = rows * box.slices;
        const std::uint32_t wrap_step = slice_step - rows * grid.tiles_x;
        std::uint32_t cell = box.first_cell, row = 0;
        for (std::uint32_t r = 0; r < row_count; ++r) {
            for (std::uint32_t column = 0; column < columns; column += 4)
                for (std::uint32_t k = 0; k < 4; ++k) scatter[column + k] = {cell + column + k, i};
            scatter += columns;
            const bool wraps = ++row == rows;
            cell += grid.tiles_x + (wraps ? wrap_step : 0);
            row = wraps ? 0 : row;
        }
    }
}

void place_cells(const Scatter* scatter, std::size_t count, std::uint32_t first_reference, MlCell* cells,
                 std::uint32_t* cursors, std::size_t cell_count) {
    std::fill_n(cursors, cell_count, 0u);
    for (std::size_t i = 0; i < count; ++i) ++cursors[scatter[i].cell];
    std::uint32_t sum = first_reference;
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
        cells[cell] = {sum, cursors[cell]};
        cursors[cell] = sum;
        sum += cells[cell].count;
    }
}

void fill_places(const Scatter* scatter, std::size_t count, std::uint32_t* cursors, std::uint32_t* references) {
    for (std::size_t i = 0; i < count; ++i) references[cursors[scatter[i].cell]++] = scatter[i].light;
}

void fill_indices(const Scatter* scatter, std::size_t count, const CellLight* lights, std::uint32_t* cursors,
                  std::uint32_t* references) {
    for (std::size_t i = 0; i < count; ++i) references[cursors[scatter[i].cell]++] = lights[scatter[i].light].index;
}

} // namespace manylights::paper
