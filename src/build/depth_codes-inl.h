// Depth codes in vectors: included once per instruction set, see lanes.h.
#if defined(MANYLIGHTS_DEPTH_CODES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANYLIGHTS_DEPTH_CODES_INL_H
#undef MANYLIGHTS_DEPTH_CODES_INL_H
#else
#define MANYLIGHTS_DEPTH_CODES_INL_H
#endif

#include "src/build/depth_codes.h"
#include "src/build/slices.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::Vec<hn::ScalableTag<float>>;
using Words = hn::Vec<hn::ScalableTag<std::uint32_t>>;
using Ints = hn::Vec<hn::ScalableTag<std::int32_t>>;
constexpr hn::ScalableTag<float> kF;
constexpr hn::ScalableTag<std::uint32_t> kW;
constexpr hn::ScalableTag<std::int32_t> kI;

struct Depths {
    Floats low, high;
};

HWY_INLINE Ints encode_depth(const DepthCodes& codes, Floats depth) {
    // Depths below 0 have negative bits.
    const Ints code = hn::ShiftRightSame(hn::BitCast(kI, depth), codes.shift) - hn::Set(kI, codes.base);
    return hn::Min(hn::Max(code, hn::Zero(kI)), hn::Set(kI, DepthCodes::kMostLow));
}
HWY_INLINE Floats begin_of(const DepthCodes& codes, Ints low) {
    return hn::BitCast(kF, hn::ShiftLeftSame(low + hn::Set(kI, codes.base), codes.shift));
}

HWY_INLINE Words encode(const DepthCodes& codes, const Depths& depths) {
    const Ints low = encode_depth(codes, depths.low);
    const Floats extent = hn::Max(depths.high - begin_of(codes, low), hn::Zero(kF));
    const Ints rounded = hn::ShiftRight<DepthCodes::kExtentShift>(hn::BitCast(kI, extent)) + hn::Set(kI, 1);
    const Ints code =
        hn::Min(hn::Max(rounded - hn::Set(kI, codes.extent_base), hn::Zero(kI)), hn::Set(kI, DepthCodes::kMostExtent));
    return hn::BitCast(kW, hn::Or(low, hn::ShiftLeft<DepthCodes::kLowBits>(code)));
}

// As low_of and high_of.
HWY_INLINE Depths decode(const DepthCodes& codes, Words span) {
    const Ints low = hn::BitCast(kI, hn::And(span, hn::Set(kW, DepthCodes::kMostLow)));
    const Ints code = hn::BitCast(kI, hn::ShiftRight<DepthCodes::kLowBits>(span));
    const Floats begin = begin_of(codes, low);
    const Ints extent = hn::ShiftLeft<DepthCodes::kExtentShift>(code + hn::Set(kI, codes.extent_base));
    const Floats infinity = hn::Inf(kF);
    const auto is_endless = hn::RebindMask(kF, code == hn::Set(kI, DepthCodes::kMostExtent));
    return {hn::IfThenElse(hn::RebindMask(kF, low == hn::Zero(kI)), hn::Neg(infinity), begin),
            hn::IfThenElse(is_endless, infinity, begin + hn::BitCast(kF, extent))};
}

// As slice_of: how many slices behind the first one begin at the depth or before it.
struct SliceRange {
    Words first, last;
};
HWY_INLINE SliceRange find_slices(const Slices& slices, const Depths& depths) {
    SliceRange range = {hn::Zero(kW), hn::Zero(kW)};
    for (std::uint32_t s = 1; s < slices.count; ++s) {
        const Floats edge = hn::Set(kF, slices.edges[s]);
        range.first = range.first - hn::VecFromMask(kW, hn::RebindMask(kW, depths.low >= edge));
        range.last = range.last - hn::VecFromMask(kW, hn::RebindMask(kW, depths.high >= edge));
    }
    return range;
}

} // namespace
} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
