// Records on their way to their tiles' chunks: included once per instruction set, see lanes.h.
#if defined(MANYLIGHTS_RECORD_EMITTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANYLIGHTS_RECORD_EMITTER_INL_H
#undef MANYLIGHTS_RECORD_EMITTER_INL_H
#else
#define MANYLIGHTS_RECORD_EMITTER_INL_H
#endif

#include "src/build/compaction-inl.h"
#include "src/build/tile_records.h"

#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::Vec<hn::ScalableTag<float>>;
using Words = hn::Vec<hn::ScalableTag<std::uint32_t>>;
using Ints = hn::Vec<hn::ScalableTag<std::int32_t>>;
using Mask = hn::Mask<hn::ScalableTag<float>>;
constexpr hn::ScalableTag<float> kF;
constexpr hn::ScalableTag<std::uint32_t> kW;
constexpr hn::ScalableTag<std::int32_t> kI;

// As many lights take each step together whatever a vector holds: a tile's order depends on it.
constexpr std::uint32_t kTogether = 16;
constexpr auto kLanes = static_cast<std::uint32_t>(hn::MaxLanes(kF));
constexpr std::uint32_t kVectors = kTogether / kLanes;
static_assert(kVectors * kLanes == kTogether);

// The records of a tile keep their order. First all places, then all records: a place that is looked up between stores
// to other places waits until it is known that none of these was to it.
HWY_NOINLINE void flush(const RecordBuffer from, std::uint32_t count, RecordPool& pool) {
    HomeCursor* const cursors = pool.cursors;
    TileRecord* const records = pool.items;
    std::uint32_t* const places = from.tile;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t tile = from.tile[i];
        HomeCursor& cursor = cursors[tile];
        std::uint32_t at = cursor.next;
        if (HWY_UNLIKELY(at == cursor.limit)) at = open_chunk(pool, tile, cursor);
        cursor.next = at + 1;
        places[i] = at;
        hwy::Prefetch(reinterpret_cast<const char*>(records + at) + 64); // for the tile's next ones
    }
    for (std::uint32_t i = 0; i < count; ++i) records[places[i]] = {from.light[i], from.near_bits[i], from.far_bits[i]};
}

// Collects records, and flushes them when there are many.
class Emitter {
  public:
    Emitter(const RecordBuffer& buffer, RecordPool& pool) : buffer_(buffer), pool_(pool) {}
    HWY_INLINE const RecordBuffer& buffer() const { return buffer_; }

    // What is stored behind the kept ones counts for nothing.
    HWY_INLINE void add(Words tile, Words light, Words near_bits, Words far_bits, Mask kept) {
        const Compaction compact(kept);
        hn::StoreU(compact(tile), kW, buffer_.tile + count_);
        hn::StoreU(compact(light), kW, buffer_.light + count_);
        hn::StoreU(compact(near_bits), kW, buffer_.near_bits + count_);
        hn::StoreU(compact(far_bits), kW, buffer_.far_bits + count_);
        count_ += compact.count();
        if (count_ >= kBufferedRecords) finish();
    }
    HWY_INLINE std::uint64_t finish() {
        flush(buffer_, count_, pool_);
        records_ += count_;
        count_ = 0;
        return records_;
    }

  private:
    const RecordBuffer buffer_;
    RecordPool& pool_;
    std::uint32_t count_ = 0;
    std::uint64_t records_ = 0;
};

} // namespace
} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
