#include "reference/paper/bin.h"

#include <algorithm>
#include <utility>

namespace manylights::paper {
namespace {

void cursors_to_counts(MlCell* cells, std::size_t cell_count) {
    for (std::size_t cell = 0; cell < cell_count; ++cell) cells[cell].count -= cells[cell].first;
}

} // namespace

// Four columns are written at a time, the surplus is overwritten by what follows: one loop over rows and slices, and
// for most lights no second one over columns.
void write_scatter(const BoundedLight* lights, std::size_t light_count, const Grid& grid, Scatter* scatter) {
    const std::uint32_t slice_step = grid.x.tiles * grid.y.tiles;
    for (std::uint32_t i = 0; i < light_count; ++i) {
        const BoundedLight& light = lights[i];
        const std::uint32_t columns = light.columns, rows = light.rows, row_count = rows * light.slices;
        const std::uint32_t wrap_step = slice_step - rows * grid.x.tiles;
        std::uint32_t cell = light.first_cell, row = 0;
        for (std::uint32_t r = 0; r < row_count; ++r) {
            for (std::uint32_t column = 0; column < columns; column += 4)
                for (std::uint32_t k = 0; k < 4; ++k) scatter[column + k] = {cell + column + k, i};
            scatter += columns;
            const bool wraps = ++row == rows;
            cell += grid.x.tiles + (wraps ? wrap_step : 0);
            row = wraps ? 0 : row;
        }
    }
}

void place_cells(const Scatter* scatter, std::size_t count, std::uint32_t first_reference, MlCell* cells,
                 std::size_t cell_count) {
    std::fill_n(cells, cell_count, MlCell{0, 0});
    for (std::size_t i = 0; i < count; ++i) ++cells[scatter[i].cell].count;
    std::uint32_t sum = first_reference;
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
        cells[cell].first = sum;
        sum += std::exchange(cells[cell].count, sum);
    }
}

void fill_places(const Scatter* scatter, std::size_t count, MlCell* cells, std::size_t cell_count,
                 std::uint32_t* references) {
    for (std::size_t i = 0; i < count; ++i) references[cells[scatter[i].cell].count++] = scatter[i].light;
    cursors_to_counts(cells, cell_count);
}

void fill_indices(const Scatter* scatter, std::size_t count, const BoundedLight* lights, MlCell* cells,
                  std::size_t cell_count, std::uint32_t* references) {
    for (std::size_t i = 0; i < count; ++i) references[cells[scatter[i].cell].count++] = lights[scatter[i].light].index;
    cursors_to_counts(cells, cell_count);
}

} // namespace manylights::paper
