// Depth windows at one tile size: spans, records, cuts, and the exact counts of what write will replay.
#include "src/build/builder.h"
#include "src/build/windows_plan.h"

#include <algorithm>
#include <cstring>

namespace manylights::detail {

namespace {

// While a light spans more tiles than this on average, larger ones cost less than they save. Its pixels are a
// rectangle: it has references in about 12 of 14 tiles.
constexpr std::uint64_t kTilesPerLight = 14;
constexpr std::uint64_t kVeryManyLights = 500000;
// What spans more than this, compared with what may be, does not fit when it is narrowed either.
constexpr std::uint64_t kNarrowsAway = 4;

// What the result may have of references at the most, to be of use at this tile size.
std::uint64_t reference_limit(const ManylightsBuilder& builder, bool has_to_do) {
    const std::uint64_t limit = builder.most_elements / builder.counts.reference_words;
    if (has_to_do) return limit;
    return std::min(limit, builder.settings.max_bytes / (builder.counts.reference_words * sizeof(MlUint)));
}

bool spans_fit(const ManylightsBuilder& builder, std::uint64_t spanned, bool has_to_do) {
    if (has_to_do) return true;
    if (builder.settings.tile_px == 0 && spanned > kTilesPerLight * visible_lights(builder)) return false;
    return spanned <= UINT32_MAX && spanned / kNarrowsAway <= reference_limit(builder, has_to_do);
}

// What comes before this tile, to share the work on tiles evenly. The buckets may be a little larger than their
// records.
std::uint64_t work_before(const Windows& windows, std::uint64_t tile) {
    constexpr std::uint64_t kWorkPerTile = 32; // records
    return tile * kWorkPerTile + windows.begins[tile * windows.light_tasks];
}

void measure_tiles(Windows& windows, std::uint64_t tile_count, std::uint32_t task) {
    const TileScratch scratch = tile_scratch(windows, task);
    const std::uint64_t work = work_before(windows, tile_count);
    const Part part = part_of(work, task, windows.tile_tasks);
    for (std::uint64_t t = first_with(tile_count, part.begin, [&](std::uint64_t i) { return work_before(windows, i); });
         t < tile_count && work_before(windows, t) < part.end; ++t) {
        const std::uint32_t count = tile_record_count(windows, t);
        windows.tiles[t] =
            count != 0 ? measure_tile(tile_records(windows, t, scratch), count, scratch.extents) : WindowTile{};
    }
}

bool measure_all(ManylightsBuilder& builder, std::uint64_t tile_count) {
    Windows& windows = builder.windows;
    if (!prepare_tile_tasks(builder, tile_count) || !windows.tiles.resize(tile_count)) return false;
    run_tasks(builder.settings, windows.tile_tasks,
              [&](std::uint32_t task) { measure_tiles(windows, tile_count, task); });
    return true;
}

// Puts the tile's references behind those of the tile before, and so its entries; returns the end of the entries.
std::uint64_t place_tile(Windows& windows, std::uint64_t index, std::uint64_t cell) {
    WindowTile& tile = windows.tiles[index];
    tile.first_reference = static_cast<std::uint32_t>(windows.references);
    tile.first_entry = static_cast<std::uint32_t>(cell);
    windows.references += tile.count;
    if (tile.count == 0) ++windows.empty_tiles;
    if (tile.form.flat_count != 0) ++windows.flat_tiles;
    return tile.count != 0 ? cell + ml_entry_cell_count(tile.form) : cell;
}

// The cells of the views: of each its headers, then its entries. Offsets are only good where the ends of references and
// cells are within 32 bits.
std::uint64_t place_tiles(ManylightsBuilder& builder) {
    Windows& windows = builder.windows;
    windows.references = windows.empty_tiles = windows.flat_tiles = 0;
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
                                       [](const View& view) { return view.lights.count >= kVeryManyLights; });
    return very_many ? 24 : 32;
}

Fit arrange_windows(ManylightsBuilder& builder, bool has_to_do) {
    Counts& counts = builder.counts;
    const std::uint64_t tile_count = counts.cells;
    counts.cells *= kHeaderCells;
    if (counts.cells > builder.most_elements) return Fit::kTooLarge;
    if (!has_to_do && !within_budget(builder)) return Fit::kOverBudget;

    std::uint64_t spanned = 0;
    if (!span_lights(builder, tile_count, spanned)) return Fit::kOutOfMemory;
    if (!spans_fit(builder, spanned, has_to_do)) return Fit::kOverBudget;
    if (!narrow_lights(builder, tile_count, spanned) || !measure_all(builder, tile_count)) return Fit::kOutOfMemory;
    counts.cells = place_tiles(builder);
    counts.references = builder.windows.references;
    if (counts.references > reference_limit(builder, true)) return Fit::kTooLarge;
    if (counts.cells > builder.most_elements) return Fit::kTooLarge;
    return within_budget(builder) ? Fit::kFits : Fit::kOverBudget;
}

} // namespace manylights::detail
