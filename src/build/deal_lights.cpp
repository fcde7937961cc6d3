// Lights to the cells of their boxes: a vector of lights to their slices, then each row of tiles at once.
#include "src/build/cells.h"
#include "src/build/lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/build/deal_lights.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "src/build/compaction-inl.h"
#include "src/build/depth_codes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

constexpr auto kLanes = static_cast<std::uint32_t>(hn::MaxLanes(kW));
// As many lights are dealt together whatever a vector holds: a cell's order depends on it.
constexpr std::uint32_t kVectors = kDealtTogether / kLanes;
static_assert(kVectors * kLanes == kDealtTogether && kDealtTogether <= kLanePadding);
static_assert(kSegmentLights <= 0x10000);

// The records of a cell keep their order. First all places, then all records: a place that is looked up between stores
// to other places waits until it is known that none of these was to it.
HWY_NOINLINE void flush(const DealBuffer& from, std::uint32_t count, CellPool& pool) {
    CellCursor* const cursors = pool.cursors;
    CellRecord* const records = pool.items;
    const CellRecord* const segment = from.segment;
    const std::uint32_t* const words = from.words;
    std::uint32_t* const places = from.cells;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t cell = places[i];
        CellCursor& cursor = cursors[cell];
        std::uint32_t at = cursor.next;
        if (HWY_UNLIKELY(at == cursor.limit)) at = open_chunk(pool, cell, cursor);
        cursor.next = at + 1;
        cursor.extent_sum += static_cast<std::uint32_t>(static_cast<std::int32_t>(words[i]) >> 16);
        places[i] = at;
        hwy::Prefetch(records + at);
    }
    for (std::uint32_t i = 0; i < count; ++i) records[places[i]] = segment[words[i] & 0xFFFF];
}

// Collects cells, and flushes them when there are many.
class Dealer {
  public:
    Dealer(const DealBuffer& buffer, CellPool& pool) : buffer_(buffer), pool_(pool) {}
    Dealer(const Dealer&) = delete;
    Dealer& operator=(const Dealer&) = delete;
    ~Dealer() { finish(); }

    // Cells side by side, at most as many as there are lanes. What is stored behind them counts for nothing.
    HWY_INLINE void put(std::uint32_t cell, Words word, std::uint32_t count) {
        hn::StoreU(hn::Set(kW, cell) + numbers_, kW, buffer_.cells + count_);
        hn::StoreU(word, kW, buffer_.words + count_);
        count_ += count;
    }
    HWY_INLINE void flush_if_full() {
        if (HWY_UNLIKELY(count_ >= kBufferedLights)) finish();
    }

  private:
    void finish() {
        flush(buffer_, count_, pool_);
        count_ = 0;
    }

    const DealBuffer buffer_; // a copy: vectors may be stored to whatever a reference is to
    CellPool& pool_;
    const Words numbers_ = hn::Iota(kW, 0);
    std::uint32_t count_ = 0;
};

// The rows of a plate. Two are put without asking: how many there are is hard to guess.
HWY_INLINE void deal_plate(std::uint32_t tiles_x, std::uint32_t cell, std::uint32_t tiles, std::uint32_t word,
                           Dealer& dealer) {
    const std::uint32_t columns = (tiles & 0xFFFF) + 1;
    const std::uint32_t rows = (tiles >> 16) + 1;
    const Words words = hn::Set(kW, word);
    if (HWY_LIKELY(columns <= kLanes)) {
        dealer.put(cell, words, columns);
        dealer.put(cell + tiles_x, words, rows > 1 ? columns : 0);
        dealer.flush_if_full();
        for (std::uint32_t y = 2; y < rows; ++y) {
            dealer.put(cell + y * tiles_x, words, columns);
            dealer.flush_if_full();
        }
        return;
    }
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; x += kLanes) {
            dealer.put(cell + y * tiles_x + x, words, HWY_MIN(columns - x, kLanes));
            dealer.flush_if_full();
        }
    }
}

// Where slices begin and end.
struct SliceEnds {
    Floats begin, end;
};

// Of lights in a slice each, less a half; in the upper half of a word.
HWY_INLINE Words find_extents(const SliceEnds& slice, const Depths& depths) {
    const Floats inside = hn::Min(depths.high, slice.end) - hn::Max(depths.low, slice.begin);
    const Floats whole =
        hn::Max(slice.end - slice.begin, hn::Set(kF, 1e-30f)); // where there is none, no point is either
    const Floats extent = hn::Max(inside, hn::Zero(kF)) / whole * hn::Set(kF, static_cast<float>(kWholeExtent));
    return hn::ShiftLeft<16>(hn::BitCast(kW, hn::ConvertTo(kI, extent) - hn::Set(kI, kWholeExtent / 2)));
}

// As find_slices, with the ends of the slices of both ends: to look them up would take longer.
struct SliceRangeEnds {
    SliceRange range;
    SliceEnds first, last;
};
HWY_INLINE SliceRangeEnds find_slice_ends(const Slices& slices, const SliceExtents& extents, const Depths& depths) {
    Words first = hn::Zero(kW);
    Words last = hn::Zero(kW);
    const Floats behind = hn::Set(kF, extents.edges[slices.count]);
    SliceEnds of_first = {hn::Zero(kF), behind};
    SliceEnds of_last = {hn::Zero(kF), behind};
    for (std::uint32_t s = slices.count - 1; s > 0; --s) {
        const Floats edge = hn::Set(kF, slices.edges[s]);
        const auto low_behind = depths.low >= edge;
        const auto high_behind = depths.high >= edge;
        first = first - hn::VecFromMask(kW, hn::RebindMask(kW, low_behind));
        last = last - hn::VecFromMask(kW, hn::RebindMask(kW, high_behind));
        of_first.begin = hn::Max(of_first.begin, hn::IfThenElseZero(low_behind, edge));
        of_last.begin = hn::Max(of_last.begin, hn::IfThenElseZero(high_behind, edge));
        of_first.end = hn::IfThenElse(low_behind, of_first.end, edge);
        of_last.end = hn::IfThenElse(high_behind, of_last.end, edge);
    }
    const Floats near_depth = hn::Set(kF, extents.edges[0]);
    of_first.begin = hn::IfThenElse(hn::RebindMask(kF, first == hn::Zero(kW)), near_depth, of_first.begin);
    of_last.begin = hn::IfThenElse(hn::RebindMask(kF, last == hn::Zero(kW)), near_depth, of_last.begin);
    return {{first, last}, of_first, of_last};
}

// A vector of lights.
struct Boxes {
    Words first_cell, tiles, slices;          // 0 slices: none
    Words first_word, middle_word, last_word; // of their slices
};

// And their records.
template <bool kExtents>
HWY_INLINE Boxes load_boxes(const DealView& view, const LightBox* boxes, std::uint32_t first, Segment segment,
                            CellRecord* records) {
    Words span, light, first_cell, tiles;
    hn::LoadInterleaved4(kW, reinterpret_cast<const std::uint32_t*>(boxes + first), span, light, first_cell, tiles);
    const std::uint32_t at = first - segment.begin;
    hn::StoreInterleaved2(light, span, kW, reinterpret_cast<std::uint32_t*>(records + at));
    const auto here = hn::FirstN(kW, first < segment.end ? segment.end - first : 0);
    const Depths depths = decode(view.codes, span);
    const Words position = hn::Set(kW, at) + hn::Iota(kW, 0);
    const Words whole = hn::Set(kW, static_cast<std::uint32_t>(kWholeExtent / 2) << 16);
    Words first_word = position;
    Words last_word = position;
    SliceRange range;
    if constexpr (kExtents) {
        const SliceRangeEnds found = find_slice_ends(*view.slices, *view.extents, depths);
        range = found.range;
        first_word = hn::Or(position, find_extents(found.first, depths));
        last_word = hn::Or(position, find_extents(found.last, depths));
    } else {
        range = find_slices(*view.slices, depths);
    }
    return {first_cell,
            tiles,
            hn::IfThenElseZero(here, range.last - range.first + hn::Set(kW, 1)),
            first_word,
            hn::Or(position, whole),
            last_word};
}

// One slice of each light that reaches so many. Returns the plates' end.
HWY_INLINE std::uint32_t add_plates(const DealView& view, const Boxes& boxes, std::uint32_t nth,
                                    const PlateBuffer& plates, std::uint32_t count) {
    const Words number = hn::Set(kW, nth);
    const Words last = boxes.slices - hn::Set(kW, 1);
    const Compaction compact(hn::RebindMask(kF, boxes.slices > number));
    const Words inner = hn::IfThenElse(last == number, boxes.last_word, boxes.middle_word);
    hn::StoreU(compact(boxes.first_cell + hn::Set(kW, nth * view.tile_count)), kW, plates.first_cell + count);
    hn::StoreU(compact(boxes.tiles), kW, plates.tiles + count);
    hn::StoreU(compact(nth == 0 ? boxes.first_word : inner), kW, plates.words + count);
    return count + compact.count();
}

template <bool kExtents>
void deal_some(const DealView& view, const LightBox* boxes, Segment segment, const DealBuffer& buffer, CellPool& pool) {
    Dealer dealer(buffer, pool);
    const PlateBuffer plates = buffer.plates;
    const std::uint32_t tiles_x = view.tiles_x;
    for (std::uint32_t begin = segment.begin; begin < segment.end; begin += kDealtTogether) {
        Boxes together[kVectors];
        Words slices = hn::Zero(kW);
        for (std::uint32_t v = 0; v < kVectors; ++v) {
            together[v] = load_boxes<kExtents>(view, boxes, begin + v * kLanes, segment, buffer.segment);
            slices = hn::Max(slices, together[v].slices);
        }
        const std::uint32_t most = hn::GetLane(hn::MaxOfLanes(kW, slices));
        std::uint32_t count = 0;
        for (std::uint32_t nth = 0; nth < most; ++nth)
            for (const Boxes& b : together) count = add_plates(view, b, nth, plates, count);
        for (std::uint32_t i = 0; i < count; ++i)
            deal_plate(tiles_x, plates.first_cell[i], plates.tiles[i], plates.words[i], dealer);
    }
}

} // namespace

std::uint64_t count_segment(const DealView& view, const LightBox* boxes, Segment segment) {
    std::uint64_t sum = 0;
    HWY_ALIGN std::uint32_t slices[kLanes];
    for (std::uint32_t i = segment.begin; i < segment.end; i += kLanes) {
        Words span, light, first_cell, tiles;
        hn::LoadInterleaved4(kW, reinterpret_cast<const std::uint32_t*>(boxes + i), span, light, first_cell, tiles);
        const SliceRange range = find_slices(*view.slices, decode(view.codes, span));
        hn::Store(range.last - range.first + hn::Set(kW, 1), kW, slices);
        for (std::uint32_t k = 0; k < HWY_MIN(segment.end - i, kLanes); ++k) {
            const std::uint32_t of_box = boxes[i + k].tiles;
            sum += std::uint64_t{(of_box & 0xFFFF) + 1} * ((of_box >> 16) + 1) * slices[k];
        }
    }
    return sum;
}

void deal_segment(const DealView& view, const LightBox* boxes, Segment segment, const DealBuffer& buffer,
                  CellPool& pool) {
    if (view.extents != nullptr)
        deal_some<true>(view, boxes, segment, buffer, pool);
    else
        deal_some<false>(view, boxes, segment, buffer, pool);
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manylights::detail {

HWY_EXPORT(count_segment);
HWY_EXPORT(deal_segment);

std::uint64_t count_segment(const DealView& view, const LightBox* boxes, Segment segment) {
    return HWY_DYNAMIC_DISPATCH(count_segment)(view, boxes, segment);
}

void deal_segment(const DealView& view, const LightBox* boxes, Segment segment, const DealBuffer& buffer,
                  CellPool& pool) {
    HWY_DYNAMIC_DISPATCH(deal_segment)(view, boxes, segment, buffer, pool);
}

} // namespace manylights::detail
#endif
