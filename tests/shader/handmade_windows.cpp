#include "tests/shader/handmade_windows.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace manylights::test {

namespace {

constexpr MlUint kTilePx = 16;

MlUint slice_of(const MadeTile& tile, MlUint code) { return (code - tile.base_code) / (1u << tile.form.slice_shift); }

struct Range {
    MlUint first, last;
};

// From the first reference whose far end reaches the slice to the last whose near end does.
Range window_of(const MadeTile& tile, const std::vector<MadeReference>& references, MlUint slice) {
    Range window{static_cast<MlUint>(references.size()), 0};
    for (MlUint i = 0; i < references.size(); ++i) {
        if (slice_of(tile, references[i].high) >= slice) window.first = std::min(window.first, i);
        if (slice_of(tile, references[i].low) <= slice) window.last = i + 1;
    }
    return window;
}

// Entries as a row of words: first and last in one, or in two where they are wide.
void append_window(const MadeTile& tile, Range window, MlUint base, std::vector<MlUint>& words) {
    if (tile.form.wide != 0) {
        words.push_back(base + window.first);
        words.push_back(base + window.last);
    } else {
        words.push_back((base + window.first) | (base + window.last) << 16);
    }
}

void append_entries(const MadeTile& tile, std::vector<MlCell>& cells) {
    const std::vector<MadeReference> small = in_slice_order(tile, tile.small), large = in_slice_order(tile, tile.large);
    std::vector<MlUint> words;
    for (MlUint slice = 0; slice <= tile.form.last_slice; ++slice) {
        append_window(tile, window_of(tile, small, slice), 0, words);
        if (tile.form.two_classes != 0)
            append_window(tile, window_of(tile, large, slice), static_cast<MlUint>(small.size()), words);
    }
    words.resize((words.size() + 1) / 2 * 2);
    for (std::size_t i = 0; i < words.size(); i += 2) cells.push_back({words[i], words[i + 1]});
}

void append_references(const MadeTile& tile, const std::vector<MadeReference>& from, MlUint shift,
                       std::vector<MlUint>& references) {
    for (const MadeReference& r : in_slice_order(tile, from)) {
        references.push_back(r.light);
        references.push_back(ml_pack_bounds(r.low >> shift, r.high >> shift, r.x0, r.x1, r.y0, r.y1));
    }
}

bool in_rectangle(const MadeReference& r, MlUint x, MlUint y) {
    return r.x0 <= x && x <= r.x1 && r.y0 <= y && y <= r.y1;
}

// The same depth modulo 256 units.
bool in_modular_depth(const MadeReference& r, MlUint code, MlUint shift) {
    const std::int64_t unit = std::int64_t{1} << shift;
    const std::int64_t distance = (code / unit - r.low / unit) % 256;
    return (distance + 256) % 256 <= r.high / unit - r.low / unit;
}

// Of the tile's references in slice order: all of a flat tile, none outside of the slices.
Range range_of(const MadeTile& tile, const std::vector<MadeReference>& references, MlUint code) {
    if (code < tile.base_code || slice_of(tile, code) > tile.form.last_slice) return {0, 0};
    if (tile.form.flat_count != 0) return {0, static_cast<MlUint>(references.size())};
    return window_of(tile, references, slice_of(tile, code));
}

void append_candidates(const MadeTile& tile, const std::vector<MadeReference>& from, MlUint shift, MlUint code,
                       MlUint x, MlUint y, std::vector<MlUint>& lights) {
    const std::vector<MadeReference> references = in_slice_order(tile, from);
    const Range range = range_of(tile, references, code);
    for (MlUint i = range.first; i < range.last; ++i)
        if (in_modular_depth(references[i], code, shift) && in_rectangle(references[i], x, y))
            lights.push_back(references[i].light);
}

} // namespace

std::vector<MadeReference> in_slice_order(const MadeTile& tile, std::vector<MadeReference> references) {
    std::ranges::stable_sort(references, {}, [&tile](const MadeReference& r) { return slice_of(tile, r.low); });
    return references;
}

void append_tiles(const std::vector<MadeTile>& tiles, std::vector<MlCell>& cells, std::vector<MlUint>& references) {
    std::size_t header = cells.size();
    cells.resize(header + 2 * tiles.size());
    for (const MadeTile& tile : tiles) {
        const bool is_empty = tile.small.empty() && tile.large.empty();
        cells[header++] = {static_cast<MlUint>(references.size() / 2), static_cast<MlUint>(cells.size())};
        cells[header++] = {is_empty ? 0 : tile.base_code, is_empty ? 0 : ml_pack_tile_form(tile.form)};
        if (!is_empty && tile.form.flat_count == 0) append_entries(tile, cells);
        append_references(tile, tile.small, tile.form.small_shift, references);
        append_references(tile, tile.large, tile.form.large_shift, references);
    }
}

std::vector<MlUint> candidates(const MadeTile& tile, MlUint code, MlUint x, MlUint y) {
    std::vector<MlUint> lights;
    append_candidates(tile, tile.small, tile.form.small_shift, code, x, y, lights);
    append_candidates(tile, tile.large, tile.form.large_shift, code, x, y, lights);
    return lights;
}

MlUint compared(const MadeTile& tile, MlUint code) {
    const Range small = range_of(tile, in_slice_order(tile, tile.small), code);
    const Range large = range_of(tile, in_slice_order(tile, tile.large), code);
    return small.last - small.first + large.last - large.first;
}

std::vector<MlUint> holders(const MadeTile& tile, MlUint code, MlUint x, MlUint y) {
    std::vector<MlUint> lights;
    for (const std::vector<MadeReference>* references : {&tile.small, &tile.large})
        for (const MadeReference& r : in_slice_order(tile, *references))
            if (r.low <= code && code <= r.high && in_rectangle(r, x, y)) lights.push_back(r.light);
    return lights;
}

MlView windows_view(MlUint tile_count, MlUint cell_count, float depth_scale) {
    MlView view{};
    view.width = kTilePx * tile_count;
    view.height = view.tile_px = kTilePx;
    view.tiles_x = tile_count;
    view.tiles_y = 1;
    view.cell_count = cell_count;
    view.structure = ML_STRUCTURE_WINDOWS;
    view.depth_scale = depth_scale;
    return view;
}

} // namespace manylights::test
