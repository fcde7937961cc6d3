// How a tile is cut: into which classes, and into which slices.
#include "src/build/windows.h"

#include "src/format/layout.h"

#include <algorithm>
#include <bit>

namespace manylights::detail {

namespace {

constexpr std::uint32_t kExtentBits = 25; // 0 to 24 of them

int width_of(std::uint32_t value) { return static_cast<int>(std::bit_width(value)); }

// Two classes: the ranges of fewer than small_bits bits, and the others; or one class, and large_count is 0.
struct Classes {
    std::uint32_t small_bits;
    std::uint32_t small_count, large_count;
    std::uint32_t small_extent, large_extent; // the largest of the class
};

// Those of so many bits and fewer are below 2^bits.
Classes split_at(const Extents& extents, std::uint32_t small_bits) {
    const std::uint32_t count = extents.counts[kExtentBits];
    const std::uint32_t below = extents.counts[small_bits];
    return {small_bits, below, count - below, extents.largest[small_bits],
            below != count ? extents.largest[kExtentBits] : 0};
}

// A depth's window holds about all references of a class that begin within the class's largest extent of it: so many,
// times the tile's depth.
std::uint64_t checks_of(const Classes& classes) {
    return static_cast<std::uint64_t>(classes.small_count) * classes.small_extent +
           static_cast<std::uint64_t>(classes.large_count) * classes.large_extent;
}

// The split with the fewest checks, if it saves two of them on average; its second word per slice costs as much to
// read.
Classes choose_classes(const Extents& extents) {
    const Classes together = split_at(extents, kExtentBits);
    const std::uint64_t depth = extents.last_code - extents.base_code + 1;
    Classes best = together;
    const auto first_bits = static_cast<std::uint32_t>(width_of(extents.least)); // none is below fewer
    for (std::uint32_t bits = first_bits; bits < kExtentBits; ++bits) {
        if (bits > first_bits && extents.counts[bits] == extents.counts[bits - 1]) continue; // the same split again
        const Classes split = split_at(extents, bits);
        if (split.large_count == 0) break;
        if (checks_of(split) < checks_of(best)) best = split;
    }
    return checks_of(best) + 2 * depth <= checks_of(together) ? best : together;
}

// Slices are a power of two wide, the least such that there are at most most_slices of them.
std::uint32_t slice_shift_for(std::uint32_t depth_span, std::uint32_t most_slices) {
    int shift = std::max(width_of(depth_span) - width_of(most_slices), 0); // with less there are twice as many
    while ((depth_span >> shift) >= most_slices) ++shift;
    return static_cast<std::uint32_t>(shift);
}

// At most 256 slices, 3/2 of the references, and no finer than a sixth of the small references' extent; a power of two
// leaves the tile between half as many and all. Half of both costs 1 to 8 % more per wave (65,536 and 8,192 lights) for
// 2 to 20 % fewer bytes; extents cut twice as fine cost 2 to 4 % less for up to 19 % more.
std::uint32_t most_slices(const Classes& classes, std::uint32_t count, std::uint64_t depth) {
    const std::uint64_t by_count = static_cast<std::uint64_t>(count) * 3 / 2;
    const std::uint64_t by_extent = 6 * depth / std::max(classes.small_extent, 1u);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>({ML_TILE_SLICES_MAX, by_count, by_extent}));
}

// The units that a class's depths are kept in: the finest in which no reference of a window is taken for one that holds
// a depth 256 units off. From a depth, near ends lie up to a slice farther and up to an extent and a slice nearer.
std::uint32_t reference_shift(std::uint32_t extent, std::uint32_t slice_shift) {
    const std::uint32_t slices = 2u << slice_shift;
    int shift = std::max(width_of(extent | slices) - 8, 0); // with less, one of them is 256 or more
    while ((extent >> shift) + 1 + (slices >> shift) > 255) ++shift;
    return static_cast<std::uint32_t>(shift);
}

MlTileForm one_slice(const Extents& extents, const Classes& together, std::uint32_t count) {
    MlTileForm form{};
    form.slice_shift = slice_shift_for(extents.last_code - extents.base_code, 1);
    form.small_shift = reference_shift(together.small_extent, form.slice_shift);
    form.wide = count > ML_WINDOW_NARROW_MAX ? 1 : 0;
    form.flat_count = count <= ML_TILE_FLAT_MAX ? count : 0;
    if (ml_pack_tile_form(form) == 0) form.slice_shift = 1; // a form of 0 says that there is no reference
    return form;
}

MlTileForm choose_form(const Extents& extents, std::uint32_t count, Classes& classes) {
    classes = split_at(extents, kExtentBits);
    if (count <= kFlatReferences) return one_slice(extents, classes, count);
    classes = choose_classes(extents);
    const std::uint32_t span = extents.last_code - extents.base_code;
    const std::uint32_t most = most_slices(classes, count, std::uint64_t{span} + 1);
    const std::uint32_t shift = slice_shift_for(span, std::max(most, 1u));
    const std::uint32_t last_slice = span >> shift;
    if (last_slice < 2) {
        classes = split_at(extents, kExtentBits);
        return one_slice(extents, classes, count);
    }
    MlTileForm form{};
    form.slice_shift = shift;
    form.last_slice = last_slice;
    form.wide = count > ML_WINDOW_NARROW_MAX ? 1 : 0;
    form.two_classes = classes.large_count != 0 ? 1 : 0;
    form.small_shift = reference_shift(classes.small_extent, shift);
    if (form.two_classes != 0) form.large_shift = reference_shift(classes.large_extent, shift);
    return form;
}

} // namespace

WindowTile cut_tile(const Extents& extents, std::uint32_t count) {
    Classes classes{};
    WindowTile tile{};
    tile.base_code = extents.base_code;
    tile.count = count;
    tile.form = choose_form(extents, count, classes);
    tile.small_bits = classes.small_bits;
    tile.small_count = classes.small_count;
    return tile;
}

} // namespace manylights::detail
