// How a tile is cut, and its references in order with the windows over them: a vector of records or of slices at a
// time, but for the loops of the counting sort.
#include "src/build/windows.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "src/build/lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/build/windows_tile.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "src/build/sums-inl.h"

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Words = hn::Vec<hn::ScalableTag<std::uint32_t>>;
using Ints = hn::Vec<hn::ScalableTag<std::int32_t>>;
constexpr hn::ScalableTag<std::uint32_t> kW;
constexpr hn::ScalableTag<std::int32_t> kI;

HWY_INLINE std::uint32_t lane_count() { return static_cast<std::uint32_t>(hn::Lanes(kW)); }

// What is below no limit: extents are compared as signed numbers.
constexpr std::uint32_t kNoExtent = 0x7FFFFFFF;

struct RecordLanes {
    Words light, near_bits, far_bits, near_code, far_code;
};

// The records of the next tile mostly follow: what is read next is fetched meanwhile, whatever tile it is of.
constexpr std::size_t kAhead = 1024;

HWY_INLINE RecordLanes load_records(const TileRecord* records) {
    RecordLanes r;
    hwy::Prefetch(reinterpret_cast<const char*>(records) + kAhead);
    hwy::Prefetch(reinterpret_cast<const char*>(records) + kAhead + 64);
    hn::LoadInterleaved3(kW, reinterpret_cast<const std::uint32_t*>(records), r.light, r.near_bits, r.far_bits);
    r.near_code = hn::And(r.near_bits, hn::Set(kW, ML_DEPTH_CODE_MAX));
    r.far_code = hn::And(r.far_bits, hn::Set(kW, ML_DEPTH_CODE_MAX));
    return r;
}

// The range of codes, and the extents and their range.
HWY_INLINE void find_extents(const TileRuns& runs, std::uint32_t* values, Extents& extents) {
    const Words nothing = hn::Set(kW, ~0u);
    Words base = nothing;
    Words last = hn::Zero(kW);
    Words least = nothing;
    Words most = hn::Zero(kW);
    std::uint32_t* out = values;
    for (std::uint32_t k = 0; k < runs.count; ++k) {
        const RecordRun run = runs.runs[k];
        for (std::uint32_t i = 0; i < run.count; i += lane_count()) {
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
    hn::StoreU(hn::Set(kW, kNoExtent), kW, out);
    extents.base_code = hn::GetLane(hn::MinOfLanes(kW, base));
    extents.last_code = hn::GetLane(hn::MaxOfLanes(kW, last));
    extents.least = hn::GetLane(hn::MinOfLanes(kW, least));
    extents.most = hn::GetLane(hn::MaxOfLanes(kW, most));
}

// Counts the extents below 2^bits and finds the largest of them; the same for one bit more.
HWY_INLINE void count_below(const std::uint32_t* values, std::uint32_t count, std::uint32_t bits, Extents& extents) {
    const Ints limits[2] = {hn::Set(kI, 1 << bits), hn::Set(kI, 2 << bits)};
    Ints below[2] = {hn::Zero(kI), hn::Zero(kI)};
    Ints largest[2] = {hn::Zero(kI), hn::Zero(kI)};
    for (std::uint32_t i = 0; i < count; i += lane_count()) {
        const Ints v = hn::BitCast(kI, hn::LoadU(kW, values + i));
        for (int k = 0; k < 2; ++k) {
            const auto is_below = v < limits[k];
            below[k] = below[k] - hn::VecFromMask(kI, is_below);
            largest[k] = hn::Max(largest[k], hn::IfThenElseZero(is_below, v));
        }
    }
    for (std::uint32_t k = 0; k < 2; ++k) {
        extents.counts[bits + k] = static_cast<std::uint32_t>(hn::GetLane(hn::SumOfLanes(kI, below[k])));
        extents.largest[bits + k] = static_cast<std::uint32_t>(hn::GetLane(hn::MaxOfLanes(kI, largest[k])));
    }
}

HWY_INLINE Extents measure_extents(const TileRuns& runs, std::uint32_t count, std::uint32_t* values) {
    Extents extents{};
    find_extents(runs, values, extents);
    const auto first_bits = static_cast<std::uint32_t>(std::bit_width(extents.least));
    const auto end_bits = static_cast<std::uint32_t>(std::bit_width(extents.most));
    if (count > kFlatReferences)
        for (std::uint32_t bits = first_bits; bits < end_bits; bits += 2) count_below(values, count, bits, extents);
    for (std::uint32_t bits = end_bits; bits < kExtentLimits; ++bits) {
        extents.counts[bits] = count;
        extents.largest[bits] = extents.most;
    }
    return extents;
}

// Of each record: its keys in the counting sort, and the reference.
HWY_INLINE void describe(const WindowTile& tile, const TileRuns& runs, const TileScratch& scratch) {
    const Words base = hn::Set(kW, tile.base_code);
    const Words limit = hn::Set(kW, 1u << tile.small_bits);
    const Words slice_shift = hn::Set(kW, tile.form.slice_shift);
    const Words small_shift = hn::Set(kW, tile.form.small_shift);
    const Words large_shift = hn::Set(kW, tile.form.large_shift);
    const Words large_class = hn::Set(kW, kClassSlices | (kClassSlices << 16));
    std::uint32_t* keys = scratch.keys;
    std::uint32_t* described = reinterpret_cast<std::uint32_t*>(scratch.described);
    for (std::uint32_t k = 0; k < runs.count; ++k) {
        const RecordRun run = runs.runs[k];
        for (std::uint32_t i = 0; i < run.count; i += lane_count()) {
            const RecordLanes r = load_records(run.records + i);
            const auto small = r.far_code - r.near_code < limit;
            const Words near_slice = hn::Shr(r.near_code - base, slice_shift);
            const Words far_slice = hn::Shr(r.far_code - base, slice_shift);
            hn::StoreU(hn::Or(near_slice, hn::ShiftLeft<16>(far_slice)) +
                           hn::IfThenElseZero(hn::Not(small), large_class),
                       kW, keys + i);
            // ml_pack_bounds.
            const Words shift = hn::IfThenElse(small, small_shift, large_shift);
            const Words low = hn::Shr(r.near_code, shift);
            const Words extent = hn::Shr(r.far_code, shift) - low;
            const Words x = hn::ShiftLeft<16>(hn::ShiftRight<24>(r.near_bits));
            const Words y = hn::And(r.far_bits, hn::Set(kW, 0xFF000000u));
            const Words depth = hn::Or(hn::And(low, hn::Set(kW, 255)), hn::ShiftLeft<8>(extent));
            hn::StoreInterleaved2(r.light, hn::Or(hn::Or(depth, x), y), kW, described + 2 * std::size_t{i});
        }
        keys += run.count;
        described += 2 * std::size_t{run.count};
    }
}

// Per slice of both classes: where its references end; and how far before the tile's last reference the first one is
// that ends in the slice. A class's slices are in its own half.
struct Tables {
    HWY_ALIGN std::uint32_t end[2 * kClassSlices];
    HWY_ALIGN std::uint32_t lead[2 * kClassSlices];
};

// A counting sort by class and slice of the near end. Within a slice the order stays: that of the chunks.
HWY_INLINE void sort_described(const WindowTile& tile, std::uint32_t slots, const TileScratch& scratch,
                               Tables& tables) {
    // Copies, so that no store may be taken for one to them.
    const std::uint32_t count = tile.count;
    const std::uint32_t* const keys = scratch.keys;
    const WindowReference* const described = scratch.described;
    WindowReference* const ordered = scratch.ordered;
    for (std::uint32_t i = 0; i < count; ++i) ++tables.end[keys[i] & 0xFFFF];
    exclusive_sums(tables.end, slots, 0);
    if (tile.form.two_classes != 0) exclusive_sums(tables.end + kClassSlices, slots, tile.small_count);
    std::uint32_t* const places = scratch.places; // all of them first, as in record_emitter-inl.h
    for (std::uint32_t i = 0; i < count; ++i) places[i] = tables.end[keys[i] & 0xFFFF]++;
    for (std::uint32_t i = 0; i < count; ++i) {
        std::uint32_t& lead = tables.lead[keys[i] >> 16];
        lead = HWY_MAX(lead, count - places[i]);
    }
    for (std::uint32_t i = 0; i < count; ++i) ordered[places[i]] = described[i];
}

// The entries, from the last slice to the first. The window of a slice ends behind the last reference that begins in it
// or before, and begins with the first one of all that end in it or behind: what is before that one ends before the
// slice. Where nothing reaches a slice its window is empty: the next one to begin ends behind it, so first is last.
class EntryWriter {
  public:
    EntryWriter(const WindowTile& tile, const Tables& tables, MlUint* entries)
        : tables_(tables), entries_(entries),
          count_(hn::Set(kSlots, tile.count)), leads_{hn::Set(kSlots, tile.count - tile.small_count),
                                                      hn::Zero(kSlots)} {}

    void write(std::uint32_t slots, const MlTileForm& form) {
        for (std::uint32_t s = slots; s != 0;) {
            s -= kSlotLanes;
            const Window small = window_of(0, s);
            if (form.two_classes != 0)
                write_both(s, form.wide != 0, small, window_of(1, s));
            else if (form.wide != 0)
                hn::StoreInterleaved2(small.first, small.end, kSlots, entries_ + 2 * std::size_t{s});
            else
                hn::StoreU(pack(small), kSlots, entries_ + s);
        }
    }

  private:
    struct Window {
        Slots first, end;
    };
    HWY_INLINE Window window_of(std::uint32_t of_class, std::uint32_t slice) {
        const std::uint32_t slot = of_class * kClassSlices + slice;
        const Slots lead = suffix_maxima(hn::LoadU(kSlots, tables_.lead + slot), leads_[of_class]);
        return {count_ - lead, hn::LoadU(kSlots, tables_.end + slot)};
    }
    static HWY_INLINE Slots pack(const Window& window) { return hn::Or(window.first, hn::ShiftLeft<16>(window.end)); }
    HWY_INLINE void write_both(std::uint32_t s, bool wide, const Window& small, const Window& large) {
        if (wide)
            hn::StoreInterleaved4(small.first, small.end, large.first, large.end, kSlots,
                                  entries_ + 4 * std::size_t{s});
        else
            hn::StoreInterleaved2(pack(small), pack(large), kSlots, entries_ + 2 * std::size_t{s});
    }

    const Tables& tables_;
    MlUint* entries_;
    const Slots count_;
    Slots leads_[2]; // of the slices behind
};

HWY_INLINE void order_slices(const WindowTile& tile, const TileScratch& scratch) {
    const std::uint32_t slices = tile.form.last_slice + 1;
    const std::uint32_t slots = round_up_slots(slices);
    Tables tables;
    for (std::uint32_t c = 0; c <= tile.form.two_classes; ++c) {
        std::memset(tables.end + c * kClassSlices, 0, slots * sizeof(std::uint32_t));
        std::memset(tables.lead + c * kClassSlices, 0, slots * sizeof(std::uint32_t));
    }
    sort_described(tile, slots, scratch, tables);
    EntryWriter(tile, tables, scratch.entries).write(slots, tile.form);
    const std::uint32_t words = slices << (tile.form.two_classes + tile.form.wide);
    if (words % 2 != 0) scratch.entries[words] = 0;
}

} // namespace

WindowTile measure_tile(const TileRuns& runs, std::uint32_t count, const TileScratch& scratch) {
    return cut_tile(measure_extents(runs, count, scratch.places), count);
}

const WindowReference* order_tile(const WindowTile& tile, const TileRuns& runs, const TileScratch& scratch) {
    describe(tile, runs, scratch);
    if (tile.form.flat_count != 0) return scratch.described;
    order_slices(tile, scratch);
    return scratch.ordered;
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manylights::detail {

HWY_EXPORT(measure_tile);
HWY_EXPORT(order_tile);

WindowTile measure_tile(const TileRuns& runs, std::uint32_t count, const TileScratch& scratch) {
    return HWY_DYNAMIC_DISPATCH(measure_tile)(runs, count, scratch);
}

const WindowReference* order_tile(const WindowTile& tile, const TileRuns& runs, const TileScratch& scratch) {
    return HWY_DYNAMIC_DISPATCH(order_tile)(tile, runs, scratch);
}

} // namespace manylights::detail
#endif
