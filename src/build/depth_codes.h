#pragma once
// The depths that a light reaches, in 32 bits: half of the work on a cell's lights is to move and compare them.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

namespace manylights::detail {

// bits 31..20: extent      bits 19..0: near end
using DepthSpan = std::uint32_t;

// The near end is a float's upper bits, less those of some least depth: as fine relative to the depth everywhere, with
// 16 bits of a mantissa for 16 octaves of depth, one more for half as many octaves, and so on. The extent is a float's
// upper bits, too: 7 of its mantissa, 32 octaves. So a tiny light far away keeps a tight range. The near end is rounded
// down and the far end up; what begins nearer than all codes begins at -inf, what ends too far behind ends at +inf.
struct DepthCodes {
    static constexpr int kLowBits = 20;
    static constexpr std::int32_t kMostLow = (1 << kLowBits) - 1;
    static constexpr std::int32_t kMostExtent = (1 << (32 - kLowBits)) - 1;
    static constexpr int kExtentShift = 16; // of a float's bits
    std::int32_t base, extent_base;
    int shift; // of a float's bits

    std::int32_t code_of(float depth) const {
        return std::clamp((std::bit_cast<std::int32_t>(depth) >> shift) - base, 0, kMostLow);
    }
    float low_of(DepthSpan span) const {
        return (span & kMostLow) == 0 ? -std::numeric_limits<float>::infinity() : begin_of(span);
    }
    float high_of(DepthSpan span) const {
        const auto extent = static_cast<std::int32_t>(span >> kLowBits);
        if (extent == kMostExtent) return std::numeric_limits<float>::infinity();
        return begin_of(span) + std::bit_cast<float>((extent + extent_base) << kExtentShift);
    }

  private:
    // Where the extent begins: finite.
    float begin_of(DepthSpan span) const {
        return std::bit_cast<float>((static_cast<std::int32_t>(span & kMostLow) + base) << shift);
    }
};

// As fine as they can be for these depths and all between; both positive.
DepthCodes make_depth_codes(float least, float most);

} // namespace manylights::detail
