#include "src/format/validate.h"

namespace manylights::detail {

namespace {

constexpr MlUint kMostShift = 24; // of a depth code's bits

// Where the next tile must begin: tiles have no gaps, so nothing of a buffer is walked twice or by nobody.
struct Places {
    std::uint64_t entry;
    std::uint64_t entry_end; // of the view
    std::uint64_t reference;
};

struct TileAt {
    std::uint64_t header; // its first cell
    MlTile tile;
    MlTileForm form;
};

Outcome validate_form(const TileAt& at) {
    const MlTileForm& form = at.form;
    if (form.slice_shift > kMostShift || form.small_shift > kMostShift || form.large_shift > kMostShift)
        return damaged("cells", "shifts must be at most 24", at.header);
    if (form.two_classes == 0 && form.large_shift != 0)
        return damaged("cells", "large_shift must be 0 with one class", at.header);
    if (form.flat_count != 0 && (form.last_slice | form.two_classes | form.wide) != 0)
        return damaged("cells", "a flat tile must have one slice, one class and no entries", at.header);
    return {};
}

Outcome validate_header(const TileAt& at, const Places& places) {
    if (at.tile.first_reference != places.reference)
        return damaged("cells", "first_reference must be the end of the tile before", at.header);
    if (at.tile.first_entry != places.entry)
        return damaged("cells", "first_entry must be the end of the tile before", at.header);
    if (at.tile.base_code > (at.tile.form == 0 ? 0 : ML_DEPTH_CODE_MAX))
        return damaged("cells", "base_code must be a depth code, and 0 in a tile without references", at.header);
    if (Outcome outcome = validate_form(at); !outcome.ok()) return outcome;
    if (at.tile.form != 0 && places.entry + ml_entry_cell_count(at.form) > places.entry_end)
        return damaged("cells", "entries must lie within the view's cells", at.header);
    return {};
}

MlWindow window_at(const Contents& contents, const TileAt& at, MlUint slice) {
    const MlCell* entry = contents.cells + at.tile.first_entry + ml_entry_cell(at.form, slice);
    const bool has_second = (at.form.two_classes & at.form.wide) != 0;
    return ml_window_from_cells(at.form, slice, entry[0], entry[has_second ? 1 : 0]);
}

// Ends that never go back and leave no gap, so that every reference from the first window's begin to the last one's end
// is in a window. first <= last follows.
bool follows(MlUint first, MlUint last, MlUint first_before, MlUint last_before) {
    return first_before <= first && first <= last_before && last_before <= last;
}

// The entries of a tile, in bounds already. before starts as the empty windows that its classes begin with.
Outcome validate_entries(const Contents& contents, const TileAt& at) {
    const MlUint small_end = window_at(contents, at, at.form.last_slice).small_last;
    MlWindow before{0, 0, small_end, small_end};
    for (MlUint slice = 0; slice <= at.form.last_slice; ++slice) {
        const MlWindow window = window_at(contents, at, slice);
        const bool large_follows = at.form.two_classes == 0 || follows(window.large_first, window.large_last,
                                                                       before.large_first, before.large_last);
        if (!follows(window.small_first, window.small_last, before.small_first, before.small_last) || !large_follows)
            return damaged("cells", "windows must begin with their class, neither go back nor leave a gap",
                           at.tile.first_entry + std::uint64_t{ml_entry_cell(at.form, slice)});
        before = window;
    }
    const std::uint64_t last_cell = std::uint64_t{at.tile.first_entry} + ml_entry_cell_count(at.form) - 1;
    const bool has_padding = (at.form.two_classes | at.form.wide) == 0 && at.form.last_slice % 2 == 0;
    if (has_padding && contents.cells[last_cell].count != 0)
        return damaged("cells", "the word behind an odd number of entries must be 0", last_cell);
    return {};
}

std::uint64_t reference_count(const Contents& contents, const TileAt& at) {
    if (at.form.flat_count != 0) return at.form.flat_count;
    const MlWindow last = window_at(contents, at, at.form.last_slice);
    return at.form.two_classes != 0 ? last.large_last : last.small_last;
}

Outcome validate_rectangles(const Contents& contents, ReferenceRange range) {
    for (std::uint64_t i = range.begin; i < range.end; ++i) {
        const MlUint bounds = contents.references[2 * i + 1];
        if (((bounds >> 16) & 15) > ((bounds >> 20) & 15) || ((bounds >> 24) & 15) > bounds >> 28)
            return damaged("references", "x0 must not exceed x1, nor y0 y1", i);
    }
    return {};
}

// Moves the places behind the tile.
Outcome validate_tile(const Contents& contents, const TileAt& at, std::uint32_t light_count, std::uint32_t* marks,
                      Places& places) {
    if (Outcome outcome = validate_header(at, places); !outcome.ok() || at.tile.form == 0) return outcome;
    if (at.form.flat_count == 0)
        if (Outcome outcome = validate_entries(contents, at); !outcome.ok()) return outcome;
    const std::uint64_t count = reference_count(contents, at);
    const ReferenceRange range{places.reference, places.reference + count};
    if (count == 0) return damaged("cells", "the form must be 0 in a tile without references", at.header);
    if ((count > ML_WINDOW_NARROW_MAX) != (at.form.wide != 0))
        return damaged("cells", "entries must be wide from 65,536 references on, and only there", at.header);
    if (range.end > contents.counts.references)
        return damaged("cells", "windows must lie within the references", at.header);
    if (Outcome outcome = validate_rectangles(contents, range); !outcome.ok()) return outcome;
    places.entry += ml_entry_cell_count(at.form);
    places.reference = range.end;
    return validate_references(contents, range, light_count, marks);
}

Outcome validate_view(const Contents& contents, const MlView& view, std::uint32_t light_count, std::uint32_t* marks,
                      std::uint64_t& reference) {
    const std::uint64_t tiles = std::uint64_t{view.tiles_x} * view.tiles_y;
    const std::uint64_t begin = view.cell_offset;
    Places places{begin + 2 * tiles, begin + view.cell_count, reference};
    for (std::uint64_t header = begin; header < begin + 2 * tiles; header += 2) {
        const MlTile tile = ml_tile_from_cells(contents.cells[header], contents.cells[header + 1]);
        const TileAt at{header, tile, ml_tile_form(tile.form)};
        if (Outcome outcome = validate_tile(contents, at, light_count, marks, places); !outcome.ok()) return outcome;
    }
    if (places.entry != places.entry_end)
        return damaged("cells", "every cell behind the headers must be an entry of a tile", places.entry);
    reference = places.reference;
    return {};
}

} // namespace

Outcome validate_windows(const Contents& contents, std::uint32_t light_count, std::uint32_t* marks) {
    std::uint64_t reference = 0;
    for (std::uint64_t v = 0; v < contents.counts.views; ++v)
        if (Outcome outcome = validate_view(contents, contents.views[v], light_count, marks, reference); !outcome.ok())
            return outcome;
    if (reference != contents.counts.references)
        return damaged("references", "every reference must belong to a tile", reference);
    return {};
}

} // namespace manylights::detail
