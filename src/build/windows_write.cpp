// Replays the depth windows that plan decided: headers, entries and references.
#include "src/build/builder.h"

#include <algorithm>
#include <cstring>

namespace manylights::detail {

namespace {

// One class of a tile: references [begin, end), relative to the tile's first.
struct ClassRange {
    std::uint32_t begin, end, shift;
};

// Per slice, what a window entry says of one class.
struct ClassWindows {
    std::uint32_t first[ML_TILE_SLICES_MAX];
    std::uint32_t last[ML_TILE_SLICES_MAX];
};

ClassRange small_class(const WindowTile& tile) { return {0, tile.small_count, tile.form.small_shift}; }
ClassRange large_class(const WindowTile& tile, std::uint32_t count) {
    return {tile.small_count, count, tile.form.large_shift};
}

// The references of a class ascend by the slice of their near end. The window of slice s ends behind the last one that
// begins in s or before, and begins with the first one of all that ends in s or behind: what is before that one ends
// before s. Where nothing reaches s the window is empty: the next one to begin ends behind s, so first is last.
void find_windows(const WindowTile& tile, const WindowRecord* records, const ClassRange& range, ClassWindows& windows) {
    const std::uint32_t slices = tile.form.last_slice + 1;
    std::fill_n(windows.first, slices, range.end);
    std::fill_n(windows.last, slices, 0u);
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        std::uint32_t& first = windows.first[slice_of_code(tile, records[i].far_code())];
        first = std::min(first, i);
        windows.last[slice_of_code(tile, records[i].near_code())] = i + 1;
    }
    for (std::uint32_t s = slices - 1; s-- > 0;) windows.first[s] = std::min(windows.first[s], windows.first[s + 1]);
    std::uint32_t last = range.begin;
    for (std::uint32_t s = 0; s < slices; ++s) {
        last = std::max(last, windows.last[s]);
        windows.last[s] = last;
    }
}

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
    void add_window(bool wide, const ClassWindows& windows, std::uint32_t slice) {
        if (!wide) return add(windows.first[slice] | (windows.last[slice] << 16));
        add(windows.first[slice]);
        add(windows.last[slice]);
    }
    void finish() {
        if (has_half_) add(0);
    }

  private:
    MlCell* next_;
    MlUint half_ = 0;
    bool has_half_ = false;
};

void write_entries(const WindowTile& tile, const WindowRecord* records, std::uint32_t count, MlCell* cells) {
    if (count == 0 || tile.form.flat_count != 0) return;
    const bool wide = tile.form.wide != 0;
    ClassWindows small, large;
    find_windows(tile, records, small_class(tile), small);
    if (tile.form.two_classes != 0) find_windows(tile, records, large_class(tile, count), large);
    EntryWriter writer(cells + tile.first_entry);
    for (std::uint32_t s = 0; s <= tile.form.last_slice; ++s) {
        writer.add_window(wide, small, s);
        if (tile.form.two_classes != 0) writer.add_window(wide, large, s);
    }
    writer.finish();
}

MlUint* write_class(const WindowRecord* records, const ClassRange& range, MlUint* out) {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const WindowRecord& record = records[i];
        const std::uint32_t x = record.near_bits >> 24;
        const std::uint32_t y = record.far_bits >> 24;
        *out++ = record.light;
        *out++ = ml_pack_bounds(record.near_code() >> range.shift, record.far_code() >> range.shift, x & 15, x >> 4,
                                y & 15, y >> 4);
    }
    return out;
}

std::uint32_t reference_count(const Windows& windows, std::uint64_t tile) {
    return windows.offsets[tile + 1] - windows.offsets[tile];
}

// Of the tiles [begin, end), all of one view: ascending, headers before entries.
void write_tile_cells(const Windows& windows, const Grid& grid, const WindowView& view, std::uint64_t begin,
                      std::uint64_t end, MlCell* cells) {
    MlCell* out = cells + view.cell_offset + kHeaderCells * (begin - grid.cell_offset);
    for (std::uint64_t t = begin; t < end; ++t) {
        const WindowTile& tile = windows.tiles[t];
        *out++ = {tile.first_reference, tile.first_entry};
        *out++ = {tile.base_code, ml_pack_tile_form(tile.form)};
    }
    for (std::uint64_t t = begin; t < end; ++t)
        write_entries(windows.tiles[t], windows.found.data() + windows.tiles[t].first_reference,
                      reference_count(windows, t), cells);
}

void write_tile_references(const Windows& windows, std::uint64_t begin, std::uint64_t end, MlUint* references) {
    MlUint* out = references + 2 * static_cast<std::size_t>(windows.offsets[begin]);
    for (std::uint64_t t = begin; t < end; ++t) {
        const WindowTile& tile = windows.tiles[t];
        const WindowRecord* records = windows.found.data() + tile.first_reference;
        out = write_class(records, small_class(tile), out);
        out = write_class(records, large_class(tile, reference_count(windows, t)), out);
    }
}

} // namespace

void write_window_tiles(const ManylightsBuilder& builder, std::uint64_t begin, std::uint64_t end,
                        const ManylightsBuffers& buffers) {
    auto* cells = static_cast<MlCell*>(buffers.cells);
    for (std::uint32_t v = 0; v < builder.view_count; ++v) {
        const Grid& grid = builder.grids[v];
        const std::uint64_t first = std::max(begin, grid.cell_offset);
        const std::uint64_t last = std::min(end, grid.cell_offset + grid.cell_count);
        if (first < last) write_tile_cells(builder.windows, grid, builder.windows.views[v], first, last, cells);
    }
    write_tile_references(builder.windows, begin, end, static_cast<MlUint*>(buffers.references));
}

} // namespace manylights::detail
