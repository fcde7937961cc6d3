// Which tiles each light spans, a vector of lights at a time.
#include "src/build/tile_records.h"

#include "src/build/lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/build/tile_spans.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include "src/build/spans-inl.h"

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::Vec<hn::ScalableTag<float>>;
using Words = hn::Vec<hn::ScalableTag<std::uint32_t>>;
constexpr hn::ScalableTag<float> kF;
constexpr hn::ScalableTag<std::uint32_t> kW;

struct AxisSpan {
    Words first_tile, last_tile, steps, is_clipped;
};

HWY_INLINE AxisSpan span_axis(Words pixels, std::uint32_t tile_px, std::uint32_t last_px) {
    const TileDivision divide(tile_px);
    const Words first = hn::And(pixels, hn::Set(kW, 0xFFFF));
    const Words last = hn::ShiftRight<16>(pixels);
    // In steps, of which a tile has 16: ml_tile_step is the rest, for whole tiles cancel.
    const Words first_steps = divide(hn::ShiftLeft<4>(first));
    const Words last_steps = divide(hn::ShiftLeft<4>(last));
    const Words steps =
        hn::Or(hn::And(first_steps, hn::Set(kW, 15)), hn::And(hn::ShiftLeft<4>(last_steps), hn::Set(kW, 240)));
    const auto clipped = hn::Or(first == hn::Zero(kW), last == hn::Set(kW, last_px));
    return {hn::ShiftRight<4>(first_steps), hn::ShiftRight<4>(last_steps), steps,
            hn::IfThenElseZero(clipped, hn::Set(kW, kSpanShapes))};
}

// Lights of a size that narrowing takes, see narrow_slack.
HWY_INLINE auto can_narrow(const LightBlock& lights, std::size_t i) {
    const Floats sum = hn::Abs(hn::LoadU(kF, lights.x + i)) + hn::Abs(hn::LoadU(kF, lights.y + i)) +
                       hn::Abs(hn::LoadU(kF, lights.depth + i)) + hn::LoadU(kF, lights.radius + i);
    return hn::And(sum >= hn::Set(kF, 1e-9f), sum <= hn::Set(kF, 4e18f));
}

HWY_INLINE Words group_of(const AxisSpan& x, const AxisSpan& y, hn::Mask<hn::ScalableTag<float>> narrows) {
    const Words columns = x.last_tile - x.first_tile;
    const Words rows = y.last_tile - y.first_tile;
    const Words group = hn::ShiftLeft<2>(rows) + columns + hn::Max(x.is_clipped, y.is_clipped);
    const auto is_small = hn::And(hn::RebindMask(kW, narrows), hn::Max(columns, rows) < hn::Set(kW, kSmallSpan));
    return hn::IfThenElse(is_small, group, hn::Set(kW, kLargeSpan));
}

// Positions by group, ascending within each. Four parts of the block are counted side by side: lights of one group tend
// to follow each other, and one count would wait for the other. A light's number in its group and part is kept with the
// group: the second pass adds what comes before, and counts nothing.
constexpr std::uint32_t kParts = 4;
constexpr int kGroupBits = 8;
constexpr std::uint32_t kGroupMask = (1u << kGroupBits) - 1;
static_assert(kSpanGroups <= kGroupMask);

struct GroupCounts {
    std::uint32_t of[kSpanGroups][kParts];
};

HWY_INLINE void order_groups(std::uint32_t* groups, std::uint32_t count, const BlockSpans& spans) {
    GroupCounts counts = {};
    const auto number = [&](std::uint32_t i, std::uint32_t part)
                            HWY_ATTR { groups[i] |= counts.of[groups[i]][part]++ << kGroupBits; };
    const std::uint32_t size = count / kParts;
    for (std::uint32_t i = 0; i < size; ++i)
        for (std::uint32_t p = 0; p < kParts; ++p) number(p * size + i, p);
    for (std::uint32_t i = kParts * size; i < count; ++i) number(i, kParts - 1);
    std::uint32_t sum = 0;
    for (std::uint32_t g = 0; g < kSpanGroups; ++g) {
        for (std::uint32_t p = 0; p < kParts; ++p) {
            const std::uint32_t here = counts.of[g][p];
            counts.of[g][p] = sum;
            sum += here;
        }
        spans.ends[g] = sum;
    }
    for (std::uint32_t p = 0; p < kParts; ++p) {
        const std::uint32_t end = p + 1 < kParts ? (p + 1) * size : count;
        for (std::uint32_t i = p * size; i < end; ++i)
            spans.order[counts.of[groups[i] & kGroupMask][p] + (groups[i] >> kGroupBits)] = i;
    }
}

} // namespace

void span_block(const SpanView& view, const LightBlock& lights, const BlockSpans& spans) {
    std::uint32_t groups[kBlockRoom];
    for (std::size_t i = 0; i < lights.count; i += hn::Lanes(kW)) {
        const AxisSpan x = span_axis(hn::LoadU(kW, lights.pixels_x + i), view.tile_px, view.last_px_x);
        const AxisSpan y = span_axis(hn::LoadU(kW, lights.pixels_y + i), view.tile_px, view.last_px_y);
        const Floats light_x = hn::LoadU(kF, lights.x + i);
        const Floats light_y = hn::LoadU(kF, lights.y + i);
        const Floats depth = hn::LoadU(kF, lights.depth + i);
        const Floats radius = hn::LoadU(kF, lights.radius + i);
        hn::StoreInterleaved4(light_x, light_y, depth, radius, kF, &spans.spheres[i].x);
        hn::StoreInterleaved4(hn::LoadU(kW, lights.index + i), hn::Or(x.first_tile, hn::ShiftLeft<16>(y.first_tile)),
                              hn::Or(x.last_tile, hn::ShiftLeft<16>(y.last_tile)),
                              hn::Or(x.steps, hn::ShiftLeft<8>(y.steps)), kW, &spans.tiles[i].light);
        hn::StoreU(group_of(x, y, can_narrow(lights, i)), kW, groups + i);
    }
    order_groups(groups, lights.count, spans);
}

std::uint64_t count_tiles(const SpanView& view, const LightBlock& lights) {
    std::uint64_t sum = 0;
    HWY_ALIGN std::uint32_t tiles[hn::MaxLanes(kW)];
    for (std::size_t i = 0; i < lights.count; i += hn::Lanes(kW)) {
        const AxisSpan x = span_axis(hn::LoadU(kW, lights.pixels_x + i), view.tile_px, view.last_px_x);
        const AxisSpan y = span_axis(hn::LoadU(kW, lights.pixels_y + i), view.tile_px, view.last_px_y);
        const Words one = hn::Set(kW, 1);
        const Words product = (x.last_tile - x.first_tile + one) * (y.last_tile - y.first_tile + one);
        hn::Store(hn::IfThenElseZero(hn::FirstN(kW, lights.count - i), product), kW, tiles);
        for (std::size_t k = 0; k < hn::Lanes(kW); ++k) sum += tiles[k];
    }
    return sum;
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manylights::detail {

HWY_EXPORT(span_block);
HWY_EXPORT(count_tiles);

void span_block(const SpanView& view, const LightBlock& lights, const BlockSpans& spans) {
    HWY_DYNAMIC_DISPATCH(span_block)(view, lights, spans);
}

std::uint64_t count_tiles(const SpanView& view, const LightBlock& lights) {
    return HWY_DYNAMIC_DISPATCH(count_tiles)(view, lights);
}

} // namespace manylights::detail
#endif
