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
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "src/build/compaction-inl.h"
#include "src/build/sums-inl.h"

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
HWY_INLINE void measure_some(const SliceLanes& slices, std::uint32_t s, const DepthArrays& sorted, std::uint32_t count,
                             SliceSums& sums) {
    SliceBounds bounds[kVectors], depth_bounds[kVectors];
    load_bounds(slices.begin + s, slices.end + s, bounds);
    load_bounds(slices.near_depth + s, slices.far_depth + s, depth_bounds);
    Words counts[kVectors], behind[kVectors], before[kVectors];
    Floats depths[kVectors];
    std::fill_n(counts, kVectors, hn::Zero(kW));
    std::fill_n(behind, kVectors, hn::Zero(kW));
    std::fill_n(before, kVectors, hn::Zero(kW));
    std::fill_n(depths, kVectors, hn::Zero(kF));
    for (std::uint32_t i = 0; i < count; ++i) {
        const Floats low = hn::Set(kF, sorted.low[i]);
        const Floats high = hn::Set(kF, sorted.high[i]);
        for (std::uint32_t v = 0; v < kVectors; ++v) {
            const Mask here = reaches(low, high, bounds[v].begin, bounds[v].end);
            const Words ones = hn::VecFromMask(kW, hn::RebindMask(kW, here));
            const Floats inside =
                hn::Max(hn::Min(high, depth_bounds[v].end) - hn::Max(low, depth_bounds[v].begin), hn::Zero(kF));
            counts[v] = counts[v] - ones;
            behind[v] = hn::Max(behind[v], hn::And(ones, hn::Set(kW, i + 1)));
            before[v] = hn::Max(before[v], hn::And(ones, hn::Set(kW, count - i)));
            depths[v] = depths[v] + hn::IfThenElseZero(here, inside);
        }
    }
    for (std::size_t v = 0; v < kVectors; ++v) {
        const std::size_t at = s + v * hn::Lanes(kF);
        hn::StoreU(counts[v], kW, sums.counts + at);
        hn::StoreU(depths[v], kF, sums.depths + at);
        hn::StoreU(hn::Set(kW, count) - before[v], kW, sums.first + at);
        hn::StoreU(behind[v], kW, sums.end + at);
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

// The middles of the records, and their range.
struct Range {
    float low, high;
};
HWY_INLINE Range find_middles(const TileRuns& runs, float* middles) {
    const Floats infinity = hn::Set(kF, std::numeric_limits<float>::infinity());
    Floats least = infinity;
    Floats most = hn::Neg(infinity);
    float* out = middles;
    for (std::uint32_t k = 0; k < runs.count; ++k) {
        const RecordRun run = runs.runs[k];
        for (std::uint32_t i = 0; i < run.count; i += static_cast<std::uint32_t>(hn::Lanes(kF))) {
            Words light, low, high;
            hn::LoadInterleaved3(kW, reinterpret_cast<const std::uint32_t*>(run.records + i), light, low, high);
            const Mask present = hn::FirstN(kF, run.count - i);
            const Floats middle = middle_of(hn::BitCast(kF, low), hn::BitCast(kF, high));
            least = hn::Min(least, hn::IfThenElse(present, middle, infinity));
            most = hn::Max(most, hn::IfThenElse(present, middle, hn::Neg(infinity)));
            hn::StoreU(middle, kF, out + i);
        }
        out += run.count;
    }
    return {hn::GetLane(hn::MinOfLanes(kF, least)), hn::GetLane(hn::MaxOfLanes(kF, most))};
}

HWY_INLINE void find_keys(std::uint32_t count, std::uint32_t bins, const Range& range, const SortScratch& scratch) {
    const float width = range.high - range.low;
    const float last = static_cast<float>(bins - 1);
    const Floats scale = hn::Set(kF, width > last * 1e-30f ? last / width : 0.0f);
    const Floats origin = hn::Set(kF, range.low);
    for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(hn::Lanes(kF))) {
        const Floats key = hn::Min((hn::LoadU(kF, scratch.middles + i) - origin) * scale, hn::Set(kF, last));
        hn::StoreU(hn::BitCast(kW, hn::ConvertTo(kI, hn::Max(key, hn::Zero(kF)))), kW, scratch.keys + i);
    }
}

// What will be written in another order than it lies there, as far as the cache next to the processor holds it.
HWY_INLINE void prefetch(const DepthArrays& arrays, std::uint32_t count) {
    for (std::uint32_t i = 0; i < HWY_MIN(count, 1024u); i += 64 / sizeof(float)) {
        hwy::Prefetch(arrays.light + i);
        hwy::Prefetch(arrays.low + i);
        hwy::Prefetch(arrays.high + i);
    }
}

} // namespace

// A counting sort; lights of one bin stay in the order of the chunks.
void sort_records(const TileRuns& runs, std::uint32_t count, const SortScratch& scratch, const DepthArrays& to) {
    prefetch(to, count);
    const std::uint32_t bins = bin_count(count);
    find_keys(count, bins, find_middles(runs, scratch.middles), scratch);
    // Copies, so that no store may be taken for one to them.
    const std::uint32_t* const keys = scratch.keys;
    const DepthArrays sorted = to;
    HWY_ALIGN std::uint32_t next[kMostBins];
    std::memset(next, 0, bins * sizeof(std::uint32_t));
    for (std::uint32_t i = 0; i < count; ++i) ++next[keys[i]];
    exclusive_sums(next, bins, 0);
    std::uint32_t* places = scratch.keys; // all of them first, as in record_emitter-inl.h
    for (std::uint32_t i = 0; i < count; ++i) places[i] = next[keys[i]]++;
    for (std::uint32_t k = 0; k < runs.count; ++k) {
        const RecordRun run = runs.runs[k];
        for (std::uint32_t i = 0; i < run.count; ++i) {
            const std::uint32_t at = places[i];
            sorted.light[at] = run.records[i].light;
            sorted.low[at] = std::bit_cast<float>(run.records[i].near_bits);
            sorted.high[at] = std::bit_cast<float>(run.records[i].far_bits);
        }
        places += run.count;
    }
}

void measure_slices(const SliceLanes& slices, const DepthArrays& sorted, std::uint32_t count, SliceSums& sums) {
    for (std::uint32_t s = 0; s < slices.count; s += kTogether) measure_some(slices, s, sorted, count, sums);
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

HWY_EXPORT(sort_records);
HWY_EXPORT(measure_slices);
HWY_EXPORT(pick_slice);

void sort_records(const TileRuns& runs, std::uint32_t count, const SortScratch& scratch, const DepthArrays& sorted) {
    HWY_DYNAMIC_DISPATCH(sort_records)(runs, count, scratch, sorted);
}

void measure_slices(const SliceLanes& slices, const DepthArrays& sorted, std::uint32_t count, SliceSums& sums) {
    HWY_DYNAMIC_DISPATCH(measure_slices)(slices, sorted, count, sums);
}

std::uint32_t pick_slice(const SliceLanes& slices, std::uint32_t slice, const DepthArrays& sorted, std::uint32_t begin,
                         std::uint32_t end, const DepthArrays& cell) {
    return HWY_DYNAMIC_DISPATCH(pick_slice)(slices, slice, sorted, begin, end, cell);
}

} // namespace manylights::detail
#endif
