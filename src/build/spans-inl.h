// The tiles of pixels: included once per instruction set, see lanes.h.
#if defined(MANYLIGHTS_SPANS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANYLIGHTS_SPANS_INL_H
#undef MANYLIGHTS_SPANS_INL_H
#else
#define MANYLIGHTS_SPANS_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

// v / tile_px for integers below 2^20, exactly: (v + 1/2) / tile_px is at least 1 / (2 tile_px) from an integer, and
// its rounding is less than 2^-23 of v / tile_px.
class TileDivision {
    using FloatTag = hwy::HWY_NAMESPACE::ScalableTag<float>;
    using IntTag = hwy::HWY_NAMESPACE::ScalableTag<std::int32_t>;
    using WordTag = hwy::HWY_NAMESPACE::ScalableTag<std::uint32_t>;
    using Words = hwy::HWY_NAMESPACE::Vec<WordTag>;

  public:
    HWY_INLINE explicit TileDivision(std::uint32_t tile_px) : inverse_(1.0f / static_cast<float>(tile_px)) {}
    HWY_INLINE Words operator()(Words v) const {
        using namespace hwy::HWY_NAMESPACE;
        const auto middle = ConvertTo(FloatTag(), BitCast(IntTag(), v)) + Set(FloatTag(), 0.5f);
        return BitCast(WordTag(), ConvertTo(IntTag(), middle * Set(FloatTag(), inverse_)));
    }

  private:
    float inverse_;
};

} // namespace
} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
