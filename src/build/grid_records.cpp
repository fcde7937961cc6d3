// Records of structures with depth slices: a light's depths, in each tile that its pixels span.
#include "src/build/lanes.h"
#include "src/build/tile_records.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/build/grid_records.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include "src/build/record_emitter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

// The depths as bits, widened by 1.25 * 2^-20: 2^-20 that a caller's depth may be off, and three roundings of 2^-24. No
// low end is infinite: each depth is behind it or not.
struct Depths {
    Words low, high;
};

HWY_INLINE Depths widen(Floats depth, Floats radius) {
    const Floats widening = hn::Set(kF, 1.25f * 0x1p-20f);
    const Floats most = hn::Set(kF, hwy::HighestValue<float>());
    const Floats low = depth - radius;
    const Floats high = depth + radius;
    return {hn::BitCast(kW, hn::Min(low - hn::Abs(low) * widening, most)),
            hn::BitCast(kW, hn::Max(high + hn::Abs(high) * widening, hn::Neg(most)))};
}

struct BoxLights {
    Words first_tile, light;
    Depths depths;
    std::uint32_t count;
};

HWY_INLINE BoxLights load_lights(const BoxView& view, const LightBlock& lights, const BlockSpans& spans,
                                 std::uint32_t i, std::uint32_t end) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kF));
    const std::uint32_t count = i < end ? HWY_MIN(end - i, lanes) : 0;
    const Words order = hn::IfThenElseZero(hn::FirstN(kW, count), hn::LoadU(kW, spans.order + i));
    const Ints at = hn::BitCast(kI, order);
    const Words first = gather(spans.first_tile, at);
    const Words tile = hn::Set(kW, view.first_tile) + hn::ShiftRight<16>(first) * hn::Set(kW, view.tiles_x) +
                       hn::And(first, hn::Set(kW, 0xFFFF));
    return {tile, gather(lights.index, at), widen(gather(lights.depth, at), gather(lights.radius, at)), count};
}

// The lights of a group, in positions [begin, end) of the order: columns x rows tiles each.
void box_group(const BoxView& view, const LightBlock& lights, const BlockSpans& spans, std::uint32_t begin,
               std::uint32_t end, std::uint32_t shape, Emitter& emitter) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kF));
    for (std::uint32_t i = begin; i < end; i += kTogether) {
        BoxLights together[kVectors];
        for (std::uint32_t v = 0; v < kVectors; ++v) together[v] = load_lights(view, lights, spans, i + v * lanes, end);
        for (std::uint32_t r = 0; r <= shape / kSmallSpan; ++r) {
            for (std::uint32_t c = 0; c <= shape % kSmallSpan; ++c) {
                const Words step = hn::Set(kW, r * view.tiles_x + c);
                for (const BoxLights& l : together)
                    emitter.add_first(l.first_tile + step, l.light, l.depths.low, l.depths.high, l.count);
            }
        }
    }
}

// The tiles of one light, a vector of columns at a time.
void box_large(const BoxView& view, const LightBlock& lights, const BlockSpans& spans, std::uint32_t at,
               Emitter& emitter) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kF));
    const std::uint32_t first = spans.first_tile[at];
    const std::uint32_t last = spans.last_tile[at];
    const Words light = hn::Set(kW, lights.index[at]);
    const Depths depths = widen(hn::Set(kF, lights.depth[at]), hn::Set(kF, lights.radius[at]));
    for (std::uint32_t y = first >> 16; y <= last >> 16; ++y) {
        const std::uint32_t row = view.first_tile + y * view.tiles_x;
        for (std::uint32_t x = first & 0xFFFF; x <= (last & 0xFFFF); x += lanes) {
            const std::uint32_t count = HWY_MIN((last & 0xFFFF) - x + 1, lanes);
            emitter.add_first(hn::Iota(kW, row + x), light, depths.low, depths.high, count);
        }
    }
}

HWY_INLINE float farthest_end(const LightBlock& lights, float farthest) {
    Floats most = hn::Set(kF, farthest);
    for (std::size_t i = 0; i < lights.count; i += hn::Lanes(kF)) {
        const Depths depths = widen(hn::LoadU(kF, lights.depth + i), hn::LoadU(kF, lights.radius + i));
        const auto present = hn::FirstN(kF, lights.count - i);
        most = hn::Max(most, hn::IfThenElse(present, hn::BitCast(kF, depths.high), most));
    }
    return hn::GetLane(hn::MaxOfLanes(kF, most));
}

} // namespace

std::uint64_t box_block(const BoxView& view, const LightBlock& lights, const BlockSpans& spans,
                        const RecordBuffer& buffer, RecordPool& pool, float& farthest) {
    Emitter emitter(buffer, pool);
    std::uint32_t begin = 0;
    for (std::uint32_t g = 0; g < kLargeSpan; ++g) {
        box_group(view, lights, spans, begin, spans.ends[g], g % kSpanShapes, emitter);
        begin = spans.ends[g];
    }
    for (std::uint32_t i = begin; i < spans.ends[kLargeSpan]; ++i)
        box_large(view, lights, spans, spans.order[i], emitter);
    farthest = farthest_end(lights, farthest);
    return emitter.finish();
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manylights::detail {

HWY_EXPORT(box_block);

std::uint64_t box_block(const BoxView& view, const LightBlock& lights, const BlockSpans& spans,
                        const RecordBuffer& buffer, RecordPool& pool, float& farthest) {
    return HWY_DYNAMIC_DISPATCH(box_block)(view, lights, spans, buffer, pool, farthest);
}

} // namespace manylights::detail
#endif
