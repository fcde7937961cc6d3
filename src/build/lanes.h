#pragma once
// What all vectorised stages share. Each is compiled once per instruction set (Highway), and the best one that the
// processor has runs. All of them make the same bits: nothing but + - * / sqrt, comparisons, conversions of numbers in
// range and integers; every result goes where it would go with one lane; and the compiler contracts nothing to fused
// multiply-adds (-ffp-contract=off), which Highway's MulAdd would do as well: it is not used.

// Sets that hardly any processor has alone; and those whose vectors have no size at compile time.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#include <cstdint>

namespace manylights::detail {

// Elements that arrays have beyond their last one, so that whole vectors may be read and written there.
constexpr std::uint32_t kLanePadding = 16;

} // namespace manylights::detail
