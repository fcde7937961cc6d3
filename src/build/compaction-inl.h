// The kept lanes of vectors side by side, in order: included once per instruction set, see lanes.h.
//
// Where the processor has no instruction for it, Highway looks the lanes' order up in a table. GCC (12 to 14) lays that
// table out on the stack anew for each vector, 1 KiB of stores that take several times as long as all the rest. So the
// table is here, and the order of one mask is looked up once for all vectors that it applies to.
#if defined(MANYLIGHTS_COMPACTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANYLIGHTS_COMPACTION_INL_H
#undef MANYLIGHTS_COMPACTION_INL_H
#else
#define MANYLIGHTS_COMPACTION_INL_H
#endif

#include "src/build/lane_orders.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {

class Compaction {
    using FloatTag = hwy::HWY_NAMESPACE::ScalableTag<float>;
    using WordTag = hwy::HWY_NAMESPACE::ScalableTag<std::uint32_t>;
    using Floats = hwy::HWY_NAMESPACE::Vec<FloatTag>;
    using Words = hwy::HWY_NAMESPACE::Vec<WordTag>;
    using Mask = hwy::HWY_NAMESPACE::Mask<FloatTag>;

  public:
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
    HWY_INLINE explicit Compaction(Mask kept)
        : kept_(kept), count_(static_cast<std::uint32_t>(hwy::HWY_NAMESPACE::CountTrue(FloatTag(), kept))) {}
    HWY_INLINE Words operator()(Words v) const {
        return hwy::HWY_NAMESPACE::Compress(v, hwy::HWY_NAMESPACE::RebindMask(WordTag(), kept_));
    }
#else
    HWY_INLINE explicit Compaction(Mask kept) : order_(order_of(bits_of(kept), count_)) {}
    HWY_INLINE Words operator()(Words v) const { return hwy::HWY_NAMESPACE::TableLookupLanes(v, order_); }
#endif
    HWY_INLINE Floats operator()(Floats v) const {
        return hwy::HWY_NAMESPACE::BitCast(FloatTag(), (*this)(hwy::HWY_NAMESPACE::BitCast(WordTag(), v)));
    }
    HWY_INLINE std::uint32_t count() const { return count_; }

  private:
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
    Mask kept_;
    std::uint32_t count_;
#else
    static constexpr std::uint32_t kLanes = hwy::HWY_NAMESPACE::MaxLanes(FloatTag());
    using Order = decltype(hwy::HWY_NAMESPACE::IndicesFromVec(WordTag(), hwy::HWY_NAMESPACE::Zero(WordTag())));

    static HWY_INLINE std::uint32_t bits_of(Mask kept) {
        std::uint8_t bits[8];
        hwy::HWY_NAMESPACE::StoreMaskBits(FloatTag(), kept, bits);
        return bits[0];
    }
    static HWY_INLINE Order order_of(std::uint32_t bits, std::uint32_t& count) {
        using namespace hwy::HWY_NAMESPACE;
        count = hwy::PopCount(bits);
        const Words digits = Set(WordTag(), kLaneOrders.of[bits]);
        const Words places = ShiftLeft<2>(Iota(WordTag(), 0));
        return IndicesFromVec(WordTag(), And(Shr(digits, places), Set(WordTag(), kLanes - 1)));
    }

    std::uint32_t count_;
    Order order_;
#endif
};

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
