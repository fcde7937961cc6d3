// The boxes of cells that lights reach, a vector of lights at a time.
#include "src/build/cells.h"
#include "src/build/lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/build/light_boxes.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include "src/build/depth_codes-inl.h"
#include "src/build/spans-inl.h"
#include "src/build/structs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

// Depths, widened by 1.375 * 2^-20: 2^-20 that a caller's depth may be off, and six roundings of 2^-24 or less: of the
// ends here, and of the far end in its code. No low end is infinite: each depth is behind it or not.
HWY_INLINE Depths widen(Floats depth, Floats radius) {
    const Floats widening = hn::Set(kF, 1.375f * 0x1p-20f);
    const Floats most = hn::Set(kF, hwy::HighestValue<float>());
    const Floats low = depth - radius;
    const Floats high = depth + radius;
    return {hn::Min(low - hn::Abs(low) * widening, most), hn::Max(high + hn::Abs(high) * widening, hn::Neg(most))};
}

HWY_INLINE Words find_bands(const BoxView& view, Floats depth, Floats radius) {
    const Words code = hn::BitCast(kW, encode_depth(view.bands.codes, depth));
    HWY_ALIGN std::uint32_t steps[hn::MaxLanes(kW)];
    hn::Store(hn::ShiftRight<kBandShift>(code), kW, steps);
    const TwoFloats found_steps = load_pairs(reinterpret_cast<const float*>(view.bands.steps), steps);
    const Words band = hn::BitCast(kW, found_steps.a);
    const Words next = hn::BitCast(kW, found_steps.b);
    const Words part = hn::And(code, hn::Set(kW, kBandStep - 1));
    const Words found = band + hn::ShiftRight<kBandShift>((next - band) * part);
    const auto large = hn::RebindMask(kW, radius >= hn::Set(kF, view.bands.large_radius));
    const Words others = hn::Set(kW, (view.bands.count >> kLargeShift)) + found;
    return hn::Set(kW, view.bands.first) + hn::IfThenElse(large, hn::ShiftRight<kLargeShift>(found), others);
}

HWY_INLINE Words low_half(Words v) { return hn::And(v, hn::Set(kW, 0xFFFF)); }

} // namespace

void box_block(const BoxView& view, const LightBlock& lights, const BlockBoxes& to, BoxSums& sums) {
    const TileDivision divide(view.tile_px);
    const Words one = hn::Set(kW, 1);
    Floats farthest = hn::Set(kF, sums.farthest);
    HWY_ALIGN std::uint32_t cells[hn::MaxLanes(kW)];
    for (std::uint32_t i = 0; i < lights.count; i += static_cast<std::uint32_t>(hn::Lanes(kF))) {
        const Floats depth = hn::LoadU(kF, lights.depth + i);
        const Floats radius = hn::LoadU(kF, lights.radius + i);
        const Depths depths = widen(depth, radius);
        const Words span = encode(view.codes, depths);
        const SliceRange slices = find_slices(*view.slices, decode(view.codes, span)); // as dealing will
        const Words pixels_x = hn::LoadU(kW, lights.pixels_x + i);
        const Words pixels_y = hn::LoadU(kW, lights.pixels_y + i);
        const Words x = divide(low_half(pixels_x));
        const Words y = divide(low_half(pixels_y));
        const Words columns = divide(hn::ShiftRight<16>(pixels_x)) - x;
        const Words rows = divide(hn::ShiftRight<16>(pixels_y)) - y;
        const Words cell = hn::Set(kW, view.first_cell) + slices.first * hn::Set(kW, view.tile_count) +
                           y * hn::Set(kW, view.tiles_x) + x;
        hn::StoreInterleaved4(span, hn::LoadU(kW, lights.index + i), cell, hn::Or(columns, hn::ShiftLeft<16>(rows)), kW,
                              reinterpret_cast<std::uint32_t*>(to.boxes + i));
        hn::StoreU(find_bands(view, depth, radius), kW, to.bands + i);
        const auto here = hn::FirstN(kF, lights.count - i);
        farthest = hn::Max(farthest, hn::IfThenElse(here, depths.high, farthest));
        // Less than 2^32 each, as all cells are.
        const Words product = (columns + one) * (rows + one) * (slices.last - slices.first + one);
        hn::Store(hn::IfThenElseZero(hn::RebindMask(kW, here), product), kW, cells);
        for (const std::uint32_t of_light : cells) sums.cells += of_light;
    }
    sums.farthest = hn::GetLane(hn::MaxOfLanes(kF, farthest));
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manylights::detail {

HWY_EXPORT(box_block);

void box_block(const BoxView& view, const LightBlock& lights, const BlockBoxes& to, BoxSums& sums) {
    HWY_DYNAMIC_DISPATCH(box_block)(view, lights, to, sums);
}

} // namespace manylights::detail
#endif
