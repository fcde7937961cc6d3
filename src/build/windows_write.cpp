// Replays the depth windows that plan decided: headers, entries and references.
#include "src/build/record_stages.h"

#include <algorithm>
#include <cstring>

namespace manylights::detail {

// A counting sort by class and slice of the near end. Within a slice the order stays: that of the chunks. The window
// of slice s ends behind the last one that begins in s or before, and begins with the first one of all that ends in s
// or behind: what is before that one ends before s. Where nothing reaches s the window is empty: the next one to begin
// ends behind s, so first is last.
void order_records(const WindowTile& tile, const TileScratch& scratch, TileWindows& windows) {
    const std::uint32_t slices = tile.form.last_slice + 1;
    const std::uint32_t classes = tile.form.two_classes + 1;
    // Copies, so that no store may be taken for one to them.
    const std::uint32_t count = tile.count;
    const std::uint32_t* const keys = scratch.slices;
    const std::uint32_t* const lights = scratch.lights;
    const std::uint32_t* const bounds = scratch.bounds;
    WindowReference* const ordered = scratch.ordered;
    for (std::uint32_t c = 0; c < classes; ++c) std::fill_n(windows.end + c * kClassSlices, slices + 1, 0u);
    for (std::uint32_t i = 0; i < count; ++i) ++windows.end[keys[i] & 0xFFFF];
    std::uint32_t sum = 0;
    for (std::uint32_t c = 0; c < classes; ++c) {
        for (std::uint32_t k = c * kClassSlices; k < c * kClassSlices + slices; ++k) {
            const std::uint32_t here = windows.end[k];
            windows.end[k] = sum;
            sum += here;
        }
        std::fill_n(windows.first + c * kClassSlices, slices, sum);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t at = windows.end[keys[i] & 0xFFFF]++;
        std::uint32_t& first = windows.first[keys[i] >> 16];
        first = std::min(first, at);
        ordered[at] = {lights[i], bounds[i]};
    }
    for (std::uint32_t c = 0; c < classes; ++c) {
        std::uint32_t* first = windows.first + c * kClassSlices;
        for (std::uint32_t s = slices - 1; s-- > 0;) first[s] = std::min(first[s], first[s + 1]);
    }
}

namespace {

// Writes words in pairs, as cells.
class EntryWriter {
  public:
    explicit EntryWriter(MlCell* cells) : next_(cells) {}

    void add(MlUint word) {
        if (has_half_)
            *next_++ = {half_, word};
        else
            half_ = word;
        has_half_ = !has_half_;
    }
    void add_window(bool wide, const TileWindows& windows, std::uint32_t key) {
        if (!wide) return add(windows.first[key] | (windows.end[key] << 16));
        add(windows.first[key]);
        add(windows.end[key]);
    }
    void finish() {
        if (has_half_) add(0);
    }

  private:
    MlCell* next_;
    MlUint half_ = 0;
    bool has_half_ = false;
};

void write_entries(const WindowTile& tile, const TileWindows& windows, MlCell* cells) {
    if (tile.form.flat_count != 0) return;
    const bool wide = tile.form.wide != 0;
    EntryWriter writer(cells + tile.first_entry);
    for (std::uint32_t s = 0; s <= tile.form.last_slice; ++s) {
        writer.add_window(wide, windows, s);
        if (tile.form.two_classes != 0) writer.add_window(wide, windows, kClassSlices + s);
    }
    writer.finish();
}

void write_tile(const ManylightsBuilder& builder, std::uint64_t index, const TileScratch& scratch, MlCell* cells,
                MlUint* references) {
    const WindowTile& tile = builder.windows.tiles[index];
    if (tile.count == 0) return;
    describe_records(tile, list_runs(builder.records, index, scratch.runs), scratch);
    TileWindows tile_windows;
    order_records(tile, scratch, tile_windows);
    write_entries(tile, tile_windows, cells);
    std::memcpy(references + 2 * std::size_t{tile.first_reference}, scratch.ordered,
                tile.count * sizeof(WindowReference));
}

// Of the tiles [begin, end), all of one view: ascending, headers before entries.
void write_headers(const Windows& windows, const Grid& grid, const WindowView& view, std::uint64_t begin,
                   std::uint64_t end, MlCell* cells) {
    MlCell* out = cells + view.cell_offset + kHeaderCells * (begin - grid.tile_offset);
    for (std::uint64_t t = begin; t < end; ++t) {
        const WindowTile& tile = windows.tiles[t];
        *out++ = {tile.first_reference, tile.first_entry};
        *out++ = {tile.base_code, ml_pack_tile_form(tile.form)};
    }
}

} // namespace

void write_window_tiles(ManylightsBuilder& builder, std::uint32_t task, std::uint64_t begin, std::uint64_t end,
                        const ManylightsBuffers& buffers) {
    auto* cells = static_cast<MlCell*>(buffers.cells);
    auto* references = static_cast<MlUint*>(buffers.references);
    const TileScratch scratch = tile_scratch(builder, task);
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        const std::uint64_t first = std::max(begin, grid.tile_offset);
        const std::uint64_t last = std::min(end, grid.tile_offset + grid.tile_count);
        if (first >= last) continue;
        write_headers(builder.windows, grid, builder.windows.views[v], first, last, cells);
        for (std::uint64_t t = first; t < last; ++t) write_tile(builder, t, scratch, cells, references);
    }
}

} // namespace manylights::detail
