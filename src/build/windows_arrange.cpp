// Depth windows at one tile size: records, cuts, and the exact counts of what write will replay.
#include "src/build/record_stages.h"

#include <algorithm>

namespace manylights::detail {

namespace {

constexpr std::size_t kScratchWords = 1 + 1 + 2 + 2; // per record, see TileScratch

// What the result may have of references at the most, to be of use at this tile size.
std::uint64_t reference_limit(const ManylightsBuilder& builder, bool has_to_do) {
    const std::uint64_t limit = builder.most_elements / builder.counts.reference_words;
    if (has_to_do) return limit;
    return std::min(limit, builder.settings.max_bytes / (builder.counts.reference_words * sizeof(MlUint)));
}

// What comes before this tile, to share the work on tiles evenly.
std::uint64_t work_before(const ManylightsBuilder& builder, std::uint64_t tile) {
    constexpr std::uint64_t kWorkPerTile = 32; // records
    const TileRecords& records = builder.records;
    return tile * kWorkPerTile +
           (tile < records.tile_count ? builder.windows.tiles[tile].first_reference : records.count);
}

// Puts the tile's references behind those of the tile before.
void place_references(ManylightsBuilder& builder) {
    Windows& windows = builder.windows;
    std::uint32_t first = 0;
    windows.largest_tile = 0;
    windows.empty_tiles = 0;
    for (std::uint64_t t = 0; t < builder.records.tile_count; ++t) {
        const std::uint32_t count = tile_record_count(builder.records, t);
        windows.tiles[t].first_reference = first;
        windows.tiles[t].count = count;
        windows.largest_tile = std::max(windows.largest_tile, count);
        windows.empty_tiles += count == 0 ? 1 : 0;
        first += count;
    }
}

std::size_t record_room(const Windows& windows) { return windows.largest_tile + kLanePadding; }
std::size_t scratch_room(const Windows& windows) { return kScratchWords * record_room(windows) + kMostEntryWords; }

// No more tasks than the largest tile leaves work for: each has room for that one.
bool prepare_tile_tasks(ManylightsBuilder& builder) {
    constexpr std::uint64_t kWorkPerTask = 1024; // records, and headers
    Windows& windows = builder.windows;
    const TileRecords& records = builder.records;
    const std::uint64_t work = records.count + kHeaderCells * records.tile_count;
    const std::uint64_t useful = records.count / std::max(windows.largest_tile, 1u) + 1;
    windows.tile_tasks = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(task_count_for(builder.settings, work, kWorkPerTask), useful));
    return windows.scratch.resize(scratch_room(windows) * windows.tile_tasks) &&
           windows.runs.resize(run_room(records, windows.largest_tile) * windows.tile_tasks);
}

void measure_tiles(ManylightsBuilder& builder, std::uint32_t task) {
    Windows& windows = builder.windows;
    const std::uint64_t tile_count = builder.records.tile_count;
    const TileScratch scratch = tile_scratch(builder, task);
    const auto before = [&](std::uint64_t tile) { return work_before(builder, tile); };
    const Part part = part_of(before(tile_count), task, windows.tile_tasks);
    const std::uint64_t end = first_with(tile_count, part.end, before);
    for (std::uint64_t t = first_with(tile_count, part.begin, before); t < end; ++t) {
        WindowTile& tile = windows.tiles[t];
        WindowTile cut{};
        if (tile.count != 0) cut = measure_tile(list_runs(builder.records, t, scratch.runs), tile.count, scratch);
        // Not first_reference: other tasks read it, to find their parts.
        tile.base_code = cut.base_code;
        tile.small_bits = cut.small_bits;
        tile.small_count = cut.small_count;
        tile.form = cut.form;
    }
}

// The cells of the views: of each its headers, then its tiles' entries. Offsets are only good where the end is within
// 32 bits.
std::uint64_t place_entries(ManylightsBuilder& builder) {
    Windows& windows = builder.windows;
    windows.flat_tiles = 0;
    std::uint64_t cell = 0;
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        windows.views[v].cell_offset = cell;
        cell += kHeaderCells * grid.tile_count;
        for (std::uint64_t t = grid.tile_offset; t < grid.tile_offset + grid.tile_count; ++t) {
            WindowTile& tile = windows.tiles[t];
            tile.first_entry = static_cast<std::uint32_t>(cell);
            if (tile.form.flat_count != 0) ++windows.flat_tiles;
            if (tile.count != 0) cell += ml_entry_cell_count(tile.form);
        }
        windows.views[v].cell_count = cell - windows.views[v].cell_offset;
    }
    return cell;
}

} // namespace

void Windows::use(const Allocator& allocator) {
    runs.use(allocator);
    scratch.use(allocator);
    tiles.use(allocator);
}

TileScratch tile_scratch(ManylightsBuilder& builder, std::uint32_t task) {
    Windows& windows = builder.windows;
    const std::size_t room = record_room(windows);
    std::uint32_t* words = windows.scratch.data() + scratch_room(windows) * task;
    return {windows.runs.data() + run_room(builder.records, windows.largest_tile) * task,
            words,
            words + room,
            reinterpret_cast<WindowReference*>(words + 2 * room),
            reinterpret_cast<WindowReference*>(words + 4 * room),
            words + 6 * room};
}

Fit arrange_windows(ManylightsBuilder& builder, const ManylightsLights& lights, bool has_to_do) {
    Counts& counts = builder.counts;
    Windows& windows = builder.windows;
    const std::uint64_t limit = reference_limit(builder, has_to_do);
    if (Fit fit = collect_records(builder, lights, limit, has_to_do); fit != Fit::kFits) return fit;
    if (!windows.tiles.resize(builder.records.tile_count)) return Fit::kOutOfMemory;
    place_references(builder);
    if (!prepare_tile_tasks(builder)) return Fit::kOutOfMemory;
    run_tasks(builder.settings, windows.tile_tasks, [&](std::uint32_t task) { measure_tiles(builder, task); });
    counts.cells = place_entries(builder);
    counts.references = builder.records.count;
    if (counts.cells > builder.most_elements) return Fit::kTooLarge;
    return within_budget(builder) ? Fit::kFits : Fit::kOverBudget;
}

} // namespace manylights::detail
