// The lights of a tile and its slices, in vectors.
#include "src/build/cells.h"
#include "src/build/lanes.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/build/cells_lanes.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include "src/build/compaction-inl.h"

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::Vec<hn::ScalableTag<float>>;
using Words = hn::Vec<hn::ScalableTag<std::uint32_t>>;
using Mask = hn::Mask<hn::ScalableTag<float>>;
constexpr hn::ScalableTag<float> kF;
constexpr hn::ScalableTag<std::uint32_t> kW;
constexpr hn::ScalableTag<std::int32_t> kI;

HWY_INLINE Mask reaches(Floats low, Floats high, Floats begin, Floats end) { return hn::And(high >= begin, low < end); }

// As many slices take each step together whatever a vector holds: the default number of them is done in one walk.
constexpr std::uint32_t kTogether = 16;
constexpr std::uint32_t kVectors = kTogether / static_cast<std::uint32_t>(hn::MaxLanes(kF));
static_assert(kVectors * hn::MaxLanes(kF) == kTogether && kTogether <= kLanePadding);

// Where slices begin and end.
struct SliceBounds {
    Floats begin, end;
};
HWY_INLINE void load_bounds(const float* begin, const float* end, SliceBounds (&bounds)[kVectors]) {
    for (std::size_t v = 0; v < kVectors; ++v)
        bounds[v] = {hn::LoadU(kF, begin + v * hn::Lanes(kF)), hn::LoadU(kF, end + v * hn::Lanes(kF))};
}

// In order, so that each slice's sum is the same with every vector.
HWY_INLINE void sum_some(const SliceLanes& slices, std::uint32_t s, const RecordRun* runs, std::uint32_t run_count,
                         SliceSums& sums) {
    SliceBounds bounds[kVectors], depth_bounds[kVectors];
    load_bounds(slices.begin + s, slices.end + s, bounds);
    load_bounds(slices.near_depth + s, slices.far_depth + s, depth_bounds);
    Words counts[kVectors];
    Floats depths[kVectors];
    std::fill_n(counts, kVectors, hn::Zero(kW));
    std::fill_n(depths, kVectors, hn::Zero(kF));
    for (std::uint32_t k = 0; k < run_count; ++k) {
        prefetch_ahead(runs, run_count, k);
        for (std::uint32_t i = 0; i < runs[k].count; ++i) {
            const Floats low = hn::Set(kF, std::bit_cast<float>(runs[k].records[i].near_bits));
            const Floats high = hn::Set(kF, std::bit_cast<float>(runs[k].records[i].far_bits));
            for (std::uint32_t v = 0; v < kVectors; ++v) {
                const Mask here = reaches(low, high, bounds[v].begin, bounds[v].end);
                const Floats inside =
                    hn::Max(hn::Min(high, depth_bounds[v].end) - hn::Max(low, depth_bounds[v].begin), hn::Zero(kF));
                counts[v] = counts[v] + hn::IfThenElseZero(hn::RebindMask(kW, here), hn::Set(kW, 1));
                depths[v] = depths[v] + hn::IfThenElseZero(here, inside);
            }
        }
    }
    for (std::size_t v = 0; v < kVectors; ++v) {
        hn::StoreU(counts[v], kW, sums.counts + s + v * hn::Lanes(kF));
        hn::StoreU(depths[v], kF, sums.depths + s + v * hn::Lanes(kF));
    }
}

// Twice the middle, within the range of a difference.
HWY_INLINE Floats middle_of(Floats low, Floats high) {
    const Floats most = hn::Set(kF, 1e30f);
    return hn::Min(hn::Max(low + high, hn::Neg(most)), most);
}

// One or two per light: more take longer to sum than they save in tests. Their counts stay in the first cache.
constexpr std::uint32_t kLeastBins = 16, kMostBins = 4096;

std::uint32_t bin_count(std::uint32_t lights) { return HWY_MAX(std::bit_ceil(HWY_MIN(lights, kMostBins)), kLeastBins); }

// Unpacks the records; the range of their middles.
struct Range {
    float low, high;
};
HWY_INLINE Range unpack(std::uint32_t run_count, const CellScratch& scratch) {
    const Floats infinity = hn::Set(kF, std::numeric_limits<float>::infinity());
    Floats least = infinity;
    Floats most = hn::Neg(infinity);
    std::uint32_t at = 0;
    for (std::uint32_t k = 0; k < run_count; ++k) {
        const RecordRun run = scratch.runs[k];
        prefetch_ahead(scratch.runs, run_count, k);
        for (std::uint32_t i = 0; i < run.count; i += static_cast<std::uint32_t>(hn::Lanes(kF))) {
            Words light, low_bits, high_bits;
            hn::LoadInterleaved3(kW, reinterpret_cast<const std::uint32_t*>(run.records + i), light, low_bits,
                                 high_bits);
            const Floats low = hn::BitCast(kF, low_bits);
            const Floats high = hn::BitCast(kF, high_bits);
            const Mask present = hn::FirstN(kF, run.count - i);
            const Floats middle = middle_of(low, high);
            least = hn::Min(least, hn::IfThenElse(present, middle, infinity));
            most = hn::Max(most, hn::IfThenElse(present, middle, hn::Neg(infinity)));
            hn::StoreU(light, kW, scratch.found.light + at + i);
            hn::StoreU(low, kF, scratch.found.low + at + i);
            hn::StoreU(high, kF, scratch.found.high + at + i);
        }
        at += run.count;
    }
    return {hn::GetLane(hn::MinOfLanes(kF, least)), hn::GetLane(hn::MaxOfLanes(kF, most))};
}

HWY_INLINE void find_keys(std::uint32_t count, std::uint32_t bins, const Range& range, const CellScratch& scratch) {
    const float width = range.high - range.low;
    const float last = static_cast<float>(bins - 1);
    const Floats scale = hn::Set(kF, width > last * 1e-30f ? last / width : 0.0f);
    const Floats origin = hn::Set(kF, range.low);
    for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(hn::Lanes(kF))) {
        const Floats middle = middle_of(hn::LoadU(kF, scratch.found.low + i), hn::LoadU(kF, scratch.found.high + i));
        const Floats key = hn::Min((middle - origin) * scale, hn::Set(kF, last));
        hn::StoreU(hn::BitCast(kW, hn::ConvertTo(kI, hn::Max(key, hn::Zero(kF)))), kW, scratch.keys + i);
    }
}

HWY_INLINE void find_some(const SliceLanes& slices, std::uint32_t s, const DepthArrays& sorted, std::uint32_t count,
                          SliceRanges& ranges) {
    SliceBounds bounds[kVectors];
    load_bounds(slices.begin + s, slices.end + s, bounds);
    Words first[kVectors], behind[kVectors];
    std::fill_n(first, kVectors, hn::Set(kW, count));
    std::fill_n(behind, kVectors, hn::Zero(kW));
    for (std::uint32_t i = 0; i < count; ++i) {
        const Floats low = hn::Set(kF, sorted.low[i]);
        const Floats high = hn::Set(kF, sorted.high[i]);
        for (std::uint32_t v = 0; v < kVectors; ++v) {
            const auto here = hn::RebindMask(kW, reaches(low, high, bounds[v].begin, bounds[v].end));
            first[v] = hn::IfThenElse(here, hn::Min(first[v], hn::Set(kW, i)), first[v]);
            behind[v] = hn::IfThenElse(here, hn::Set(kW, i + 1), behind[v]);
        }
    }
    for (std::size_t v = 0; v < kVectors; ++v) {
        hn::StoreU(first[v], kW, ranges.first + s + v * hn::Lanes(kF));
        hn::StoreU(behind[v], kW, ranges.end + s + v * hn::Lanes(kF));
    }
}

} // namespace

void sum_slices(const SliceLanes& slices, const RecordRun* runs, std::uint32_t run_count, SliceSums& sums) {
    for (std::uint32_t s = 0; s < slices.count; s += kTogether) sum_some(slices, s, runs, run_count, sums);
}

// A counting sort; lights of one bin stay in the order of the chunks.
void sort_records(std::uint32_t run_count, std::uint32_t count, const CellScratch& scratch) {
    const std::uint32_t bins = bin_count(count);
    find_keys(count, bins, unpack(run_count, scratch), scratch);
    // Copies, so that no store may be taken for one to them.
    const std::uint32_t* const keys = scratch.keys;
    const DepthArrays found = scratch.found;
    const DepthArrays sorted = scratch.sorted;
    std::uint32_t next[kMostBins];
    std::memset(next, 0, bins * sizeof(std::uint32_t));
    for (std::uint32_t i = 0; i < count; ++i) ++next[keys[i]];
    std::uint32_t sum = 0;
    for (std::uint32_t b = 0; b < bins; ++b) {
        const std::uint32_t here = next[b];
        next[b] = sum;
        sum += here;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t at = next[keys[i]]++;
        sorted.light[at] = found.light[i];
        sorted.low[at] = found.low[i];
        sorted.high[at] = found.high[i];
    }
}

void find_ranges(const SliceLanes& slices, const DepthArrays& sorted, std::uint32_t count, SliceRanges& ranges) {
    for (std::uint32_t s = 0; s < slices.count; s += kTogether) find_some(slices, s, sorted, count, ranges);
}

std::uint32_t pick_slice(const SliceLanes& slices, std::uint32_t slice, const DepthArrays& sorted, std::uint32_t begin,
                         std::uint32_t end, const DepthArrays& cell) {
    const Floats slice_begin = hn::Set(kF, slices.begin[slice]);
    const Floats slice_end = hn::Set(kF, slices.end[slice]);
    std::uint32_t count = 0;
    for (std::uint32_t i = begin; i < end; i += static_cast<std::uint32_t>(hn::Lanes(kF))) {
        const Floats low = hn::LoadU(kF, sorted.low + i);
        const Floats high = hn::LoadU(kF, sorted.high + i);
        const Mask here = hn::And(hn::FirstN(kF, end - i), reaches(low, high, slice_begin, slice_end));
        const Compaction compact(here);
        hn::StoreU(compact(hn::LoadU(kW, sorted.light + i)), kW, cell.light + count);
        hn::StoreU(compact(low), kF, cell.low + count);
        hn::StoreU(compact(high), kF, cell.high + count);
        count += compact.count();
    }
    return count;
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manylights::detail {

HWY_EXPORT(sum_slices);
HWY_EXPORT(sort_records);
HWY_EXPORT(find_ranges);
HWY_EXPORT(pick_slice);

void sum_slices(const SliceLanes& slices, const RecordRun* runs, std::uint32_t run_count, SliceSums& sums) {
    HWY_DYNAMIC_DISPATCH(sum_slices)(slices, runs, run_count, sums);
}

void sort_records(std::uint32_t run_count, std::uint32_t count, const CellScratch& scratch) {
    HWY_DYNAMIC_DISPATCH(sort_records)(run_count, count, scratch);
}

void find_ranges(const SliceLanes& slices, const DepthArrays& sorted, std::uint32_t count, SliceRanges& ranges) {
    HWY_DYNAMIC_DISPATCH(find_ranges)(slices, sorted, count, ranges);
}

std::uint32_t pick_slice(const SliceLanes& slices, std::uint32_t slice, const DepthArrays& sorted, std::uint32_t begin,
                         std::uint32_t end, const DepthArrays& cell) {
    return HWY_DYNAMIC_DISPATCH(pick_slice)(slices, slice, sorted, begin, end, cell);
}

} // namespace manylights::detail
#endif
