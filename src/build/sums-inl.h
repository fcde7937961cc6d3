// Running sums and maxima over the slots of a counting sort: included once per instruction set, see lanes.h.
//
// Vectors of 128 bits everywhere: each step takes the last lane of the one before, which longer vectors only reach in
// twice the time.
#if defined(MANYLIGHTS_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANYLIGHTS_SUMS_INL_H
#undef MANYLIGHTS_SUMS_INL_H
#else
#define MANYLIGHTS_SUMS_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

constexpr hwy::HWY_NAMESPACE::CappedTag<std::uint32_t, 4> kSlots;
using Slots = hwy::HWY_NAMESPACE::Vec<decltype(kSlots)>;
constexpr auto kSlotLanes = static_cast<std::uint32_t>(hwy::HWY_NAMESPACE::MaxLanes(kSlots)); // 4; 1 without vectors

HWY_INLINE std::uint32_t round_up_slots(std::uint32_t count) {
    return (count + (kSlotLanes - 1)) / kSlotLanes * kSlotLanes;
}

// Lane i becomes the sum of the lanes up to i.
HWY_INLINE Slots prefix_sums(Slots v) {
#if HWY_TARGET != HWY_SCALAR
    v = v + hwy::HWY_NAMESPACE::ShiftLeftLanes<1>(kSlots, v);
    v = v + hwy::HWY_NAMESPACE::ShiftLeftLanes<2>(kSlots, v);
#endif
    return v;
}

// Each of counts becomes the sum of those before it, and of before. So many as whole vectors hold.
HWY_INLINE void exclusive_sums(std::uint32_t* counts, std::uint32_t count, std::uint32_t before) {
    using namespace hwy::HWY_NAMESPACE;
    Slots carry = Set(kSlots, before);
    for (std::uint32_t i = 0; i < count; i += kSlotLanes) {
        const Slots v = LoadU(kSlots, counts + i);
        const Slots sums = prefix_sums(v) + carry;
        StoreU(sums - v, kSlots, counts + i);
        carry = Broadcast<kSlotLanes - 1>(sums);
    }
}

// Lane i becomes the largest of the lanes from i on, and of behind; which becomes the first lane.
HWY_INLINE Slots suffix_maxima(Slots v, Slots& behind) {
    using namespace hwy::HWY_NAMESPACE;
#if HWY_TARGET != HWY_SCALAR
    v = Max(v, ShiftRightLanes<1>(kSlots, v));
    v = Max(v, ShiftRightLanes<2>(kSlots, v));
#endif
    v = Max(v, behind);
    behind = Broadcast<0>(v);
    return v;
}

} // namespace
} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
