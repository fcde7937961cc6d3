// Depth windows at one tile size: records, cuts, and the exact counts of what write will replay.
#include "src/build/builder.h"

#include <algorithm>

namespace manylights::detail {

namespace {

// While a light takes more references than this on average, larger tiles cost less than they save.
constexpr std::uint64_t kReferencesPerLight = 12;
constexpr std::uint64_t kVeryManyLights = 500000;

// What the result may have of references at the most, to be of use at this tile size.
std::uint64_t reference_limit(const ManylightsBuilder& builder, bool has_to_do) {
    std::uint64_t limit = builder.most_elements / builder.counts.reference_words;
    if (has_to_do) return limit;
    if (builder.settings.tile_px == 0) limit = std::min(limit, kReferencesPerLight * visible_lights(builder));
    return std::min(limit, builder.settings.max_bytes / (builder.counts.reference_words * sizeof(MlUint)));
}

// Puts the tile's references behind those of the tile before, and so its entries; returns the end of the entries.
std::uint64_t place_tile(Windows& windows, std::uint64_t index, std::uint64_t cell) {
    const std::uint32_t first = windows.offsets[index];
    const std::uint32_t count = windows.offsets[index + 1] - first;
    WindowTile& tile = windows.tiles[index];
    tile = count != 0 ? cut_tile(windows.by_tile.data() + first, count, windows.found.data() + first) : WindowTile{};
    tile.first_reference = first;
    tile.first_entry = static_cast<std::uint32_t>(cell);
    if (count == 0) ++windows.empty_tiles;
    if (tile.form.flat_count != 0) ++windows.flat_tiles;
    return count != 0 ? cell + ml_entry_cell_count(tile.form) : cell;
}

// The cells of the views: of each its headers, then its entries. Offsets are only good where the end is within 32 bits.
std::uint64_t place_tiles(ManylightsBuilder& builder) {
    Windows& windows = builder.windows;
    windows.empty_tiles = windows.flat_tiles = 0;
    std::uint64_t cell = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        windows.views[v].cell_offset = cell;
        cell += kHeaderCells * grid.cell_count;
        for (std::uint64_t t = grid.cell_offset; t < grid.cell_offset + grid.cell_count; ++t)
            cell = place_tile(windows, t, cell);
        windows.views[v].cell_count = cell - windows.views[v].cell_offset;
    }
    return cell;
}

} // namespace

std::uint32_t first_tile_px(const ManylightsBuilder& builder) {
    if (builder.settings.tile_px != 0) return builder.settings.tile_px;
    const bool very_many = std::any_of(builder.views, builder.views + builder.view_count,
                                       [](const View& view) { return view.lights.size() >= kVeryManyLights; });
    return very_many ? 24 : 32;
}

// The records' own order is done with once they are in tile order: its memory takes the final order.
Fit arrange_windows(ManylightsBuilder& builder, bool has_to_do) {
    Counts& counts = builder.counts;
    Windows& windows = builder.windows;
    const std::uint64_t tile_count = counts.cells;
    counts.cells *= kHeaderCells;
    if (counts.cells > builder.most_elements) return Fit::kTooLarge;
    if (!has_to_do && !within_budget(builder)) return Fit::kOverBudget;

    bool fits = false;
    const std::uint64_t limit = reference_limit(builder, has_to_do);
    if (!bin_windows(builder.grids, builder.views, builder.view_count, limit, windows, fits)) return Fit::kOutOfMemory;
    if (!fits) return has_to_do ? Fit::kTooLarge : Fit::kOverBudget;
    if (!windows.tiles.resize(tile_count)) return Fit::kOutOfMemory;
    counts.references = windows.found.size();
    counts.cells = place_tiles(builder);
    if (counts.cells > builder.most_elements) return Fit::kTooLarge;
    return within_budget(builder) ? Fit::kFits : Fit::kOverBudget;
}

} // namespace manylights::detail
