// How each tile is cut: its extents a vector of records at a time, and the choice itself.
#include "src/build/windows.h"

#include "src/format/layout.h"

#include <algorithm>
#include <bit>

#include "src/build/lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/build/windows_tile.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Words = hn::Vec<hn::ScalableTag<std::uint32_t>>;
constexpr hn::ScalableTag<std::uint32_t> kW;

struct RecordLanes {
    Words light, near_bits, far_bits, near_code, far_code;
};

HWY_INLINE RecordLanes load_records(const TileRecord* records) {
    RecordLanes r;
    hn::LoadInterleaved3(kW, reinterpret_cast<const std::uint32_t*>(records), r.light, r.near_bits, r.far_bits);
    r.near_code = hn::And(r.near_bits, hn::Set(kW, ML_DEPTH_CODE_MAX));
    r.far_code = hn::And(r.far_bits, hn::Set(kW, ML_DEPTH_CODE_MAX));
    return r;
}

// Counts the extents below 2^bits and finds the largest of them. Behind the last one are those that are below none.
HWY_INLINE void count_below(const std::uint32_t* values, std::uint32_t count, std::uint32_t bits, Extents& extents) {
    const Words limit = hn::Set(kW, 1u << bits);
    Words largest = hn::Zero(kW);
    std::size_t below = 0;
    for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(hn::Lanes(kW))) {
        const Words v = hn::LoadU(kW, values + i);
        const auto mask = v < limit;
        below += hn::CountTrue(kW, mask);
        largest = hn::Max(largest, hn::IfThenElseZero(mask, v));
    }
    extents.counts[bits] = static_cast<std::uint32_t>(below);
    extents.largest[bits] = hn::GetLane(hn::MaxOfLanes(kW, largest));
}

} // namespace

Extents measure_extents(const RecordRun* runs, std::uint32_t run_count, std::uint32_t count, std::uint32_t* values) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kW));
    const Words nothing = hn::Set(kW, ~0u);
    Words base = nothing;
    Words last = hn::Zero(kW);
    Words least = nothing;
    Words most = hn::Zero(kW);
    std::uint32_t* out = values;
    for (std::uint32_t k = 0; k < run_count; ++k) {
        const RecordRun run = runs[k];
        prefetch_ahead(runs, run_count, k);
        for (std::uint32_t i = 0; i < run.count; i += lanes) {
            const RecordLanes r = load_records(run.records + i);
            const auto present = hn::FirstN(kW, run.count - i);
            const Words extent = r.far_code - r.near_code;
            base = hn::Min(base, hn::IfThenElse(present, r.near_code, nothing));
            last = hn::Max(last, hn::IfThenElseZero(present, r.far_code));
            most = hn::Max(most, hn::IfThenElseZero(present, extent));
            least = hn::Min(least, hn::IfThenElse(present, extent, nothing));
            hn::StoreU(extent, kW, out + i);
        }
        out += run.count;
    }
    hn::StoreU(nothing, kW, out); // below no limit
    Extents extents = {hn::GetLane(hn::MinOfLanes(kW, base)), hn::GetLane(hn::MaxOfLanes(kW, last)), {}, {}};
    const std::uint32_t largest = hn::GetLane(hn::MaxOfLanes(kW, most));
    const auto first_bits = static_cast<std::uint32_t>(std::bit_width(hn::GetLane(hn::MinOfLanes(kW, least))));
    const auto end_bits = static_cast<std::uint32_t>(std::bit_width(largest));
    if (count > kFlatReferences)
        for (std::uint32_t bits = first_bits; bits < end_bits; ++bits) count_below(values, count, bits, extents);
    for (std::uint32_t bits = end_bits; bits < 26; ++bits) {
        extents.counts[bits] = count;
        extents.largest[bits] = largest;
    }
    return extents;
}

void describe_records(const WindowTile& tile, std::uint32_t run_count, const TileScratch& scratch) {
    const Words base = hn::Set(kW, tile.base_code);
    const Words limit = hn::Set(kW, 1u << tile.small_bits);
    const Words slice_shift = hn::Set(kW, tile.form.slice_shift);
    const Words small_shift = hn::Set(kW, tile.form.small_shift);
    const Words large_shift = hn::Set(kW, tile.form.large_shift);
    std::uint32_t at = 0;
    for (std::uint32_t k = 0; k < run_count; ++k) {
        const RecordRun run = scratch.runs[k];
        prefetch_ahead(scratch.runs, run_count, k);
        for (std::uint32_t i = 0; i < run.count; i += static_cast<std::uint32_t>(hn::Lanes(kW))) {
            const RecordLanes r = load_records(run.records + i);
            const auto small = r.far_code - r.near_code < limit;
            const Words near_slice = hn::Shr(r.near_code - base, slice_shift);
            const Words far_slice = hn::Shr(r.far_code - base, slice_shift);
            const Words of_class = hn::IfThenElseZero(hn::Not(small), hn::Set(kW, kClassSlices));
            hn::StoreU(r.light, kW, scratch.lights + at + i);
            hn::StoreU(hn::Or(near_slice + of_class, hn::ShiftLeft<16>(far_slice + of_class)), kW,
                       scratch.slices + at + i);
            // ml_pack_bounds.
            const Words shift = hn::IfThenElse(small, small_shift, large_shift);
            const Words low = hn::Shr(r.near_code, shift);
            const Words extent = hn::Shr(r.far_code, shift) - low;
            const Words x = hn::ShiftLeft<16>(hn::ShiftRight<24>(r.near_bits));
            const Words y = hn::And(r.far_bits, hn::Set(kW, 0xFF000000u));
            const Words depth = hn::Or(hn::And(low, hn::Set(kW, 255)), hn::ShiftLeft<8>(extent));
            hn::StoreU(hn::Or(hn::Or(depth, x), y), kW, scratch.bounds + at + i);
        }
        at += run.count;
    }
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manylights::detail {

HWY_EXPORT(measure_extents);
HWY_EXPORT(describe_records);

Extents measure_extents(const RecordRun* runs, std::uint32_t run_count, std::uint32_t count, std::uint32_t* values) {
    return HWY_DYNAMIC_DISPATCH(measure_extents)(runs, run_count, count, values);
}

void describe_records(const WindowTile& tile, std::uint32_t run_count, const TileScratch& scratch) {
    HWY_DYNAMIC_DISPATCH(describe_records)(tile, run_count, scratch);
}

namespace {

constexpr std::uint32_t kExtentBits = 25; // 0 to 24 of them

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
    for (std::uint32_t bits = 0; bits < kExtentBits; ++bits) {
        if (extents.counts[bits] == (bits != 0 ? extents.counts[bits - 1] : 0)) continue; // the same split again
        const Classes split = split_at(extents, bits);
        if (split.large_count == 0) break;
        if (checks_of(split) < checks_of(best)) best = split;
    }
    return checks_of(best) + 2 * depth <= checks_of(together) ? best : together;
}

// Slices are a power of two wide, the least such that there are at most most_slices of them.
std::uint32_t slice_shift_for(std::uint32_t depth_span, std::uint32_t most_slices) {
    std::uint32_t shift = 0;
    while ((depth_span >> shift) >= most_slices) ++shift;
    return shift;
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
    std::uint32_t shift = 0;
    while ((extent >> shift) + 1 + ((2u << slice_shift) >> shift) > 255) ++shift;
    return shift;
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
    classes = choose_classes(extents);
    const std::uint32_t span = extents.last_code - extents.base_code;
    const std::uint32_t most = most_slices(classes, count, std::uint64_t{span} + 1);
    const std::uint32_t shift = slice_shift_for(span, std::max(most, 1u));
    const std::uint32_t last_slice = span >> shift;
    if (count <= kFlatReferences || last_slice < 2) {
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

WindowTile measure_tile(const RecordRun* runs, std::uint32_t run_count, std::uint32_t count, std::uint32_t* values) {
    const Extents extents = measure_extents(runs, run_count, count, values);
    Classes classes{};
    WindowTile tile{};
    tile.base_code = extents.base_code;
    tile.count = count;
    tile.form = choose_form(extents, count, classes);
    tile.small_bits = classes.small_bits;
    return tile;
}

} // namespace manylights::detail
#endif
