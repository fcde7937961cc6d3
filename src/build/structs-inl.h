// Vectors from structures of two or four words that lie anywhere: included once per instruction set, see lanes.h.
//
// A processor's gather takes a cycle or two per lane and field (AMD Zen 3). A structure's fields lie side by side, so
// one load gets them all, and a few shuffles sort them to their vectors: a quarter of the time of four gathers.
#if defined(MANYLIGHTS_STRUCTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANYLIGHTS_STRUCTS_INL_H
#undef MANYLIGHTS_STRUCTS_INL_H
#else
#define MANYLIGHTS_STRUCTS_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

struct TwoFloats {
    hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::ScalableTag<float>> a, b;
};
struct FourFloats {
    hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::ScalableTag<float>> a, b, c, d;
};

#if HWY_TARGET != HWY_SCALAR
// Two words each for the lanes row, row + 1, row + 4, row + 5...: side by side.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> load_pair_rows(D d, const float* base, const std::uint32_t* words) {
    using namespace hwy::HWY_NAMESPACE;
    const Half<D> half;
    if constexpr (MaxLanes(D()) <= 4)
        return Combine(d, LoadU(half, base + words[1]), LoadU(half, base + words[0]));
    else
        return Combine(d, load_pair_rows(half, base, words + MaxLanes(half)), load_pair_rows(half, base, words));
}

// Four words each for the lanes row, row + 4, row + 8...: side by side, 128 bits each.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> load_rows(D d, const float* base, const std::uint32_t* words) {
    using namespace hwy::HWY_NAMESPACE;
    if constexpr (MaxLanes(D()) <= 4) {
        return LoadU(d, base + words[0]);
    } else {
        const Half<D> half;
        return Combine(d, load_rows(half, base, words + MaxLanes(half)), load_rows(half, base, words));
    }
}
#endif

// words: per lane, where its structure begins.
HWY_INLINE TwoFloats load_pairs(const float* base, const std::uint32_t* words) {
    using namespace hwy::HWY_NAMESPACE;
    const ScalableTag<float> d;
#if HWY_TARGET == HWY_SCALAR
    return {Set(d, base[words[0]]), Set(d, base[words[0] + 1])};
#else
    const auto row0 = load_pair_rows(d, base, words);
    const auto row2 = load_pair_rows(d, base, words + 2);
    const auto low = InterleaveLower(d, row0, row2);
    const auto high = InterleaveUpper(d, row0, row2);
    return {InterleaveLower(d, low, high), InterleaveUpper(d, low, high)};
#endif
}

HWY_INLINE FourFloats load_structs(const float* base, const std::uint32_t* words) {
    using namespace hwy::HWY_NAMESPACE;
    const ScalableTag<float> d;
#if HWY_TARGET == HWY_SCALAR
    const float* const at = base + words[0];
    return {Set(d, at[0]), Set(d, at[1]), Set(d, at[2]), Set(d, at[3])};
#else
    const auto row0 = load_rows(d, base, words);
    const auto row1 = load_rows(d, base, words + 1);
    const auto row2 = load_rows(d, base, words + 2);
    const auto row3 = load_rows(d, base, words + 3);
    const auto low02 = InterleaveLower(d, row0, row2);
    const auto low13 = InterleaveLower(d, row1, row3);
    const auto high02 = InterleaveUpper(d, row0, row2);
    const auto high13 = InterleaveUpper(d, row1, row3);
    return {InterleaveLower(d, low02, low13), InterleaveUpper(d, low02, low13), InterleaveLower(d, high02, high13),
            InterleaveUpper(d, high02, high13)};
#endif
}

} // namespace
} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
