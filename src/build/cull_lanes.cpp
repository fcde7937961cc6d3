// Culling, a vector of lights at a time.
#include "src/build/cull.h"

#include <cstring>

#include "src/build/lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/build/cull_lanes.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include "src/build/compaction-inl.h"

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using FloatTag = hn::ScalableTag<float>;
using WordTag = hn::ScalableTag<std::uint32_t>;
using IntTag = hn::ScalableTag<std::int32_t>;
using Floats = hn::Vec<FloatTag>;
using Words = hn::Vec<WordTag>;
using Mask = hn::Mask<FloatTag>;
constexpr FloatTag kF;
constexpr WordTag kW;
constexpr std::size_t kMaxLanes = hn::MaxLanes(kF);

struct Spheres {
    Floats x, y, z, range;
};

// Lights [i, i + lanes); what is behind the last one has the range 0.
HWY_INLINE Spheres load_spheres(const LightSpan& lights, std::size_t i) {
    const std::size_t lanes = hn::Lanes(kF);
    HWY_ALIGN float copies[4 * kMaxLanes];
    const char* from = lights.spheres + i * lights.stride;
    const float* packed = reinterpret_cast<const float*>(from);
    if (lights.stride != sizeof(ManylightsSphere) || i + lanes > lights.count) {
        std::memset(copies, 0, sizeof(copies));
        const std::size_t count = HWY_MIN(lanes, lights.count - i);
        for (std::size_t k = 0; k < count; ++k)
            std::memcpy(copies + 4 * k, from + k * lights.stride, sizeof(ManylightsSphere));
        packed = copies;
    }
    Spheres spheres;
    hn::LoadInterleaved4(kF, packed, spheres.x, spheres.y, spheres.z, spheres.range);
    return spheres;
}

// "Keep if" forms: a NaN fails every comparison.
HWY_INLINE Mask is_usable(const Spheres& s) {
    const Floats most = hn::Set(kF, hwy::HighestValue<float>());
    const Mask finite = hn::And(hn::And(hn::Abs(s.x) <= most, hn::Abs(s.y) <= most), hn::Abs(s.z) <= most);
    return hn::And(finite, s.range >= hn::Zero(kF));
}

struct InView {
    Floats x, y, depth, radius;
    Mask is_ordinary; // its squares and products stay within the range of floats
};

HWY_INLINE InView transform(const ViewCull& cull, const Spheres& s) {
    const Floats x = s.x - hn::Set(kF, cull.position[0]);
    const Floats y = s.y - hn::Set(kF, cull.position[1]);
    const Floats z = s.z - hn::Set(kF, cull.position[2]);
    const auto row = [&](int i) HWY_ATTR {
        return hn::Set(kF, cull.rotation[i][0]) * x + hn::Set(kF, cull.rotation[i][1]) * y +
               hn::Set(kF, cull.rotation[i][2]) * z;
    };
    const Floats distance = hn::Abs(x) + hn::Abs(y) + hn::Abs(z);
    const Floats extent =
        hn::Max(hn::Max(hn::Abs(s.x), hn::Abs(s.y)), hn::Max(hn::Abs(s.z), hn::Set(kF, cull.position_extent)));
    const Floats reach = hn::Min(s.range, hn::Set(kF, kEverywhere)) + hn::Set(kF, cull.motion_margin);
    const Floats rounding =
        hn::Set(kF, cull.slack) * (reach + distance) + hn::Set(kF, cull.world_slack) * extent + hn::Set(kF, 1e-20f);
    return {row(0), row(1), row(2), reach + rounding, distance <= hn::Set(kF, 1e18f)};
}

// Is the sphere outside of a side plane of the image? slack: see cut_side in narrow-inl.h.
HWY_INLINE Mask is_outside(const ViewCull& cull, const InView& v) {
    const Floats slack = (hn::Abs(v.x) + hn::Abs(v.y) + hn::Abs(v.depth) + v.radius) * hn::Set(kF, 0x1p-20f);
    Mask outside = hn::FirstN(kF, 0);
    for (int side = 0; side < 4; ++side) {
        const Floats offset = side < 2 ? v.x : v.y;
        const Floats distance =
            hn::Set(kF, cull.side_offset[side]) * offset + hn::Set(kF, cull.side_depth[side]) * v.depth + slack;
        outside = hn::Or(outside, distance <= hn::Neg(v.radius));
    }
    return outside;
}

struct Pixels {
    Words range; // first | last << 16
    Mask empty;
};

// The slopes of both tangents of a circle in front of the camera (depth z > radius r) at the offset a:
//     (a z +- r S) / (z^2 - r^2),   S = sqrt(a^2 + z^2 - r^2)
// No digit is lost: z^2 - r^2 = (z - r)(z + r); and where a z and r S would cancel, the tangent on the camera's side is
// the other one's conjugate, (a^2 - r^2) / (a z +- r S). So with A = |a|, the outer one (away from the axis) is
// (A z + r S) / ((z - r)(z + r)), the inner one (A - r)(A + r) / (A z + r S). Each is off by at most 11 roundings of
// 2^-24, and is widened by 32.
HWY_INLINE Pixels find_pixels(const ViewCull& cull, int axis, Floats offset, Floats depth, Floats radius,
                              Floats squared_near, Floats inverse_near) {
    const Floats widening = hn::Set(kF, 0x1p-19f);
    const Floats a = hn::Abs(offset);
    const Floats root = hn::Sqrt(a * a + squared_near);
    const Floats sum = a * depth + radius * root;
    Floats outer = sum * inverse_near;
    Floats inner = (a - radius) * (a + radius) / sum;
    outer = outer + outer * widening;
    inner = inner - hn::Abs(inner) * widening;
    const Mask mirrored = offset < hn::Zero(kF);
    const Floats high = hn::IfThenElse(mirrored, hn::Neg(inner), outer);
    const Floats low = hn::IfThenElse(mirrored, hn::Neg(outer), inner);

    const Floats scale = hn::Set(kF, cull.scale[axis]);
    const Floats origin = hn::Set(kF, cull.origin[axis]);
    const Floats p = origin + scale * low;
    const Floats q = origin + scale * high;
    const Floats reach = hn::Set(kF, cull.reach[axis]);
    const Floats half = hn::Set(kF, 0.5f);
    const Floats end = hn::Set(kF, cull.last_px[axis]);
    const Floats first = hn::Max(hn::Ceil(hn::Min(p, q) - half - reach), hn::Zero(kF));
    const Floats last = hn::Min(hn::Floor(hn::Max(p, q) - half + reach), end);
    const Mask kept = hn::And(first <= last, hn::And(first <= end, last >= hn::Zero(kF)));
    const IntTag ints;
    const Floats first_px = hn::Min(first, end); // in range before they are converted
    const Floats last_px = hn::Max(last, hn::Zero(kF));
    const Words packed = hn::Or(hn::BitCast(kW, hn::ConvertTo(ints, first_px)),
                                hn::ShiftLeft<16>(hn::BitCast(kW, hn::ConvertTo(ints, last_px))));
    return {packed, hn::Not(kept)};
}

// One vector's lights, in memory.
struct LaneCopies {
    HWY_ALIGN float x[kMaxLanes], y[kMaxLanes], depth[kMaxLanes], radius[kMaxLanes];
    HWY_ALIGN std::uint32_t pixels_x[kMaxLanes], pixels_y[kMaxLanes], kept[kMaxLanes], special[kMaxLanes];
};

// The lights that take doubles, one by one.
HWY_NOINLINE void find_special(const ViewCull& cull, const LightSpan& lights, std::size_t i, Mask special,
                               Mask ordinary, InView& v, Words& pixels_x, Words& pixels_y, Mask& kept) {
    LaneCopies copies;
    HWY_ALIGN std::uint32_t is_ordinary[kMaxLanes];
    const Words ones = hn::Set(kW, 1);
    hn::Store(v.x, kF, copies.x);
    hn::Store(v.y, kF, copies.y);
    hn::Store(v.depth, kF, copies.depth);
    hn::Store(v.radius, kF, copies.radius);
    hn::Store(pixels_x, kW, copies.pixels_x);
    hn::Store(pixels_y, kW, copies.pixels_y);
    hn::Store(hn::IfThenElseZero(hn::RebindMask(kW, kept), ones), kW, copies.kept);
    hn::Store(hn::IfThenElseZero(hn::RebindMask(kW, special), ones), kW, copies.special);
    hn::Store(hn::IfThenElseZero(hn::RebindMask(kW, ordinary), ones), kW, is_ordinary);
    for (std::size_t k = 0; k < hn::Lanes(kF); ++k) {
        if (copies.special[k] == 0) continue;
        FoundLight found = {copies.x[k], copies.y[k], copies.depth[k], copies.radius[k], 0, 0};
        ManylightsSphere light;
        std::memcpy(&light, lights.spheres + (i + k) * lights.stride, sizeof(light));
        light.range = HWY_MIN(light.range, kEverywhere);
        copies.kept[k] = (is_ordinary[k] != 0 ? find_bounds(cull, found) : find_in_view(cull, light, found)) ? 1 : 0;
        copies.x[k] = found.x;
        copies.y[k] = found.y;
        copies.depth[k] = found.depth;
        copies.radius[k] = found.radius;
        copies.pixels_x[k] = found.pixels_x;
        copies.pixels_y[k] = found.pixels_y;
    }
    v.x = hn::Load(kF, copies.x);
    v.y = hn::Load(kF, copies.y);
    v.depth = hn::Load(kF, copies.depth);
    v.radius = hn::Load(kF, copies.radius);
    pixels_x = hn::Load(kW, copies.pixels_x);
    pixels_y = hn::Load(kW, copies.pixels_y);
    kept = hn::RebindMask(kF, hn::Load(kW, copies.kept) != hn::Zero(kW));
}

// What is stored behind the kept lanes counts for nothing. (Storing only the kept ones takes longer.)
HWY_INLINE void append(LightBlock& block, const InView& v, Words index, Words pixels_x, Words pixels_y, Mask kept) {
    const Compaction compact(kept);
    hn::StoreU(compact(v.x), kF, block.x + block.count);
    hn::StoreU(compact(v.y), kF, block.y + block.count);
    hn::StoreU(compact(v.depth), kF, block.depth + block.count);
    hn::StoreU(compact(v.radius), kF, block.radius + block.count);
    hn::StoreU(compact(index), kW, block.index + block.count);
    hn::StoreU(compact(pixels_x), kW, block.pixels_x + block.count);
    hn::StoreU(compact(pixels_y), kW, block.pixels_y + block.count);
    block.count += compact.count();
}

HWY_INLINE void add_ignored(const LightSpan& lights, std::size_t i, Mask usable, Ignored& ignored) {
    const Mask bad = hn::Not(usable); // what is behind the last light is usable
    if (hn::AllFalse(kF, bad)) return;
    if (ignored.count == 0) ignored.first = lights.first + i + static_cast<std::uint64_t>(hn::FindFirstTrue(kF, bad));
    ignored.count += hn::CountTrue(kF, bad);
}

} // namespace

Ignored cull_block(const ViewCull& cull, const LightSpan& lights, LightBlock& result) {
    LightBlock block = result;
    block.count = 0;
    Ignored ignored = {0, 0};
    for (std::size_t i = 0; i < lights.count; i += hn::Lanes(kF)) {
        const Spheres spheres = load_spheres(lights, i);
        InView v = transform(cull, spheres);
        // Strict membership: no point is nearer than 0.
        const Mask usable = is_usable(spheres);
        add_ignored(lights, i, usable, ignored);
        const Mask present = hn::And(usable, spheres.range > hn::Zero(kF));
        const Floats front = v.depth - v.radius;
        const Mask between =
            hn::And(v.depth + v.radius >= hn::Set(kF, cull.near_depth), front <= hn::Set(kF, cull.far_depth));
        const Mask maybe = hn::AndNot(is_outside(cull, v), between);
        const Mask candidates = hn::And(present, hn::Or(maybe, hn::Not(v.is_ordinary)));
        if (hn::AllFalse(kF, candidates)) continue;

        const Mask in_front = hn::And(front > hn::Zero(kF), v.depth >= hn::Set(kF, 1e-12f));
        Mask simple = hn::And(candidates, hn::And(v.is_ordinary, in_front));
        if (!cull.has_float_bounds) simple = hn::FirstN(kF, 0);
        const Floats squared_near = front * (v.depth + v.radius);
        const Floats inverse_near = hn::Set(kF, 1.0f) / squared_near;
        const Pixels x = find_pixels(cull, 0, v.x, v.depth, v.radius, squared_near, inverse_near);
        const Pixels y = find_pixels(cull, 1, v.y, v.depth, v.radius, squared_near, inverse_near);
        Words pixels_x = x.range;
        Words pixels_y = y.range;
        Mask kept = hn::AndNot(hn::Or(x.empty, y.empty), simple);
        const Mask special = hn::AndNot(simple, candidates);
        if (!hn::AllFalse(kF, special))
            find_special(cull, lights, i, special, v.is_ordinary, v, pixels_x, pixels_y, kept);
        const Words index = hn::Set(kW, static_cast<std::uint32_t>(lights.first + i)) + hn::Iota(kW, 0);
        append(block, v, index, pixels_x, pixels_y, kept);
    }
    result.count = block.count;
    return ignored;
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manylights::detail {

HWY_EXPORT(cull_block);

Ignored cull_block(const ViewCull& cull, const LightSpan& lights, LightBlock& block) {
    return HWY_DYNAMIC_DISPATCH(cull_block)(cull, lights, block);
}

} // namespace manylights::detail
#endif
