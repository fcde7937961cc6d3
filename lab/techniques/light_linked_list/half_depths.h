// Depths as half floats: one text for C++ (tests) and GLSL. Whole numbers throughout, so every device rounds alike, and
// a code never descends with the depth. Depths are not below 0.
#ifndef MANYLIGHTS_LAB_HALF_DEPTHS_H
#define MANYLIGHTS_LAB_HALF_DEPTHS_H

#include <manylights/format.h>

#if defined(__cplusplus)
#include <bit>
namespace manylights::lab {
inline MlUint floatBitsToUint(float value) { return std::bit_cast<MlUint>(value); }
inline float uintBitsToFloat(MlUint bits) { return std::bit_cast<float>(bits); }
#endif

const MlUint kHalfLeast = 0x0400u;    // 2^-14, the least one with all its bits: smaller depths are 0 or this
const MlUint kHalfLargest = 0x7BFFu;  // 65504
const MlUint kHalfInfinity = 0x7C00u; // stands for every depth above
const MlUint kHalfBias = 112u << 23u; // between the exponents of the two formats, as bits of a float
const float kHalfEnd = 65536.0f;      // where the exponents of the shorter one end

// The largest half that is not above the depth.
ML_FN MlUint half_below(float depth) {
    if (!(depth >= 6.103515625e-5f)) return 0u;
    if (depth >= kHalfEnd) return kHalfLargest;
    return (floatBitsToUint(depth) - kHalfBias) >> 13u;
}

// The smallest half that is not below the depth.
ML_FN MlUint half_above(float depth) {
    if (!(depth > 6.103515625e-5f)) return kHalfLeast;
    if (depth >= kHalfEnd) return kHalfInfinity;
    return (floatBitsToUint(depth) - kHalfBias + 0x1FFFu) >> 13u;
}

// The half next to the depth, as a conversion usually rounds: on either side of it.
ML_FN MlUint half_nearest(float depth) {
    if (!(depth >= 6.103515625e-5f)) return 0u;
    if (depth >= kHalfEnd) return kHalfInfinity;
    MlUint bits = floatBitsToUint(depth) - kHalfBias;
    return (bits + 0x0FFFu + ((bits >> 13u) & 1u)) >> 13u;
}

ML_FN float depth_of_half(MlUint half_bits) {
    if (half_bits == 0u) return 0.0f;
    return uintBitsToFloat(half_bits >= kHalfInfinity ? 0x7F800000u : (half_bits << 13u) + kHalfBias);
}

#if defined(__cplusplus)
} // namespace manylights::lab
#endif

#endif
