// Records: each light's depths and rectangle in each of its tiles, a vector of lights or of tiles at a time.
#include "src/build/tile_records.h"

#include "src/build/lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/build/windows_narrow.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include "src/build/narrow-inl.h"
#include "src/build/record_emitter-inl.h"
#include "src/build/structs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace manylights::detail::HWY_NAMESPACE {
namespace {

using Spheres = WedgeSpheres<Floats>;
using Cuts = WedgeCuts<Floats>;

// ml_depth_code.
HWY_INLINE Words depth_code(Floats depth, float scale) {
    const Floats scaled = hn::Max(depth * hn::Set(kF, scale), hn::Zero(kF));
    return hn::BitCast(kW, hn::ConvertTo(kI, hn::Min(scaled, hn::Set(kF, 16777215.0f))));
}

// What a vector of records has in common.
struct Records {
    Words tile, light, steps_x, steps_y;
};

// The range is clipped to the planes between which points are promised anything. kept: of the lanes, what may be there.
HWY_INLINE void emit(const NarrowView& view, const Records& records, const Cuts& column, const Cuts& row, Floats slack,
                     Mask kept, Emitter& emitter) {
    const Floats low = hn::Max(finish_low(column.low, row.low, slack), hn::Set(kF, view.near_depth));
    const Floats high = hn::Min(finish_high(column.high, row.high, slack), hn::Set(kF, view.far_depth));
    kept = hn::And(kept, low <= high);
    const Words near_bits = hn::Or(depth_code(low, view.depth_scale), hn::ShiftLeft<24>(records.steps_x));
    const Words far_bits = hn::Or(depth_code(high, view.depth_scale), hn::ShiftLeft<24>(records.steps_y));
    emitter.add(records.tile, records.light, near_bits, far_bits, kept);
}

// The lights of a group, in positions [begin, end) of the order: columns x rows tiles each.
struct SpanGroup {
    std::uint32_t begin, end;
    std::uint32_t columns, rows;
    bool is_clipped; // by the image's edge: then also the outermost planes cut
};

// The planes of a tile.
struct TilePlanes {
    Floats before_offset, before_depth, behind_offset, behind_depth;
};

// Which of them cut: of tile number step of count along an axis none towards where the light ends, unless the image
// does.
struct PlanesInUse {
    bool before, behind;
};
HWY_INLINE PlanesInUse planes_in_use(std::uint32_t step, std::uint32_t count, bool is_clipped) {
    return {step > 0 || is_clipped, step + 1 < count || is_clipped};
}

HWY_INLINE bool has_planes(PlanesInUse use) { return use.before || use.behind; }

// Of tile number step; first: per lane, where the planes of tile 0 begin.
HWY_INLINE TilePlanes load_planes(const AxisPlanes* planes, const std::uint32_t* first, std::uint32_t step) {
    const FourFloats loaded = load_structs(&planes[step].before_offset, first);
    return {loaded.a, loaded.b, loaded.c, loaded.d};
}

HWY_INLINE Cuts cut_tile(const Spheres& spheres, const TilePlanes& planes, PlanesInUse use) {
    Cuts cuts = uncut(spheres);
    if (use.before) cut_side(spheres, planes.before_offset, planes.before_depth, cuts);
    if (use.behind) cut_side(spheres, planes.behind_offset, planes.behind_depth, cuts);
    return cuts;
}

// The steps of tile number step of count: only the outermost ones are reached in part.
HWY_INLINE Words steps_of(Words steps, std::uint32_t step, std::uint32_t count, std::uint32_t full) {
    const Words first = step == 0 ? hn::And(steps, hn::Set(kW, 15)) : hn::Zero(kW);
    const Words last = step + 1 == count ? hn::And(steps, hn::Set(kW, 240)) : hn::Set(kW, full << 4);
    return hn::Or(first, last);
}

// A vector of a group's lights.
struct GroupLights {
    Spheres along_x, along_y;
    Words first_tile, light, steps;
    Mask present;
    HWY_ALIGN std::uint32_t column_planes[kLanes], row_planes[kLanes]; // where those of the first tile begin, in words
};
constexpr int kStructShift = 2; // of four words each

HWY_INLINE void load_lights(const NarrowView& view, const BlockSpans& spans, std::uint32_t i, std::uint32_t end,
                            GroupLights& loaded) {
    loaded.present = hn::FirstN(kF, i < end ? end - i : 0);
    const Words order = hn::IfThenElseZero(hn::RebindMask(kW, loaded.present), hn::LoadU(kW, spans.order + i));
    HWY_ALIGN std::uint32_t words[kLanes];
    hn::Store(hn::ShiftLeft<kStructShift>(order), kW, words);
    const FourFloats sphere = load_structs(&spans.spheres->x, words);
    const FourFloats tiles = load_structs(reinterpret_cast<const float*>(spans.tiles), words);
    const Floats slack = narrow_slack(sphere.a, sphere.b, sphere.c, sphere.d);
    const Words first = hn::BitCast(kW, tiles.b);
    const Words column = hn::And(first, hn::Set(kW, 0xFFFF));
    const Words row = hn::ShiftRight<16>(first);
    loaded.along_x = {sphere.a, sphere.c, sphere.d, slack};
    loaded.along_y = {sphere.b, sphere.c, sphere.d, slack};
    loaded.first_tile = hn::Set(kW, view.first_tile) + row * hn::Set(kW, view.tiles_x) + column;
    loaded.light = hn::BitCast(kW, tiles.a);
    loaded.steps = hn::BitCast(kW, tiles.d);
    hn::Store(hn::ShiftLeft<kStructShift>(column), kW, loaded.column_planes);
    hn::Store(hn::ShiftLeft<kStructShift>(row), kW, loaded.row_planes);
}

HWY_INLINE void narrow_row(const NarrowView& view, const SpanGroup& group, const GroupLights (&lights)[kVectors],
                           const TilePlanes (&columns)[kSmallSpan][kVectors], std::uint32_t r, Emitter& emitter) {
    const PlanesInUse use = planes_in_use(r, group.rows, group.is_clipped);
    Cuts rows[kVectors];
    Spheres caps[kVectors];
    for (std::uint32_t v = 0; v < kVectors; ++v) {
        const GroupLights& l = lights[v];
        rows[v] =
            has_planes(use) ? cut_tile(l.along_y, load_planes(view.rows, l.row_planes, r), use) : uncut(l.along_y);
        caps[v] = caps_of(l.along_x, rows[v]);
    }
    for (std::uint32_t c = 0; c < group.columns; ++c) {
        const PlanesInUse use_column = planes_in_use(c, group.columns, group.is_clipped);
        for (std::uint32_t v = 0; v < kVectors; ++v) {
            const GroupLights& l = lights[v];
            const Records records = {l.first_tile + hn::Set(kW, r * view.tiles_x + c), l.light,
                                     steps_of(l.steps, c, group.columns, view.full_steps),
                                     steps_of(hn::ShiftRight<8>(l.steps), r, group.rows, view.full_steps)};
            emit(view, records, cut_tile(caps[v], columns[c][v], use_column), rows[v], l.along_x.slack, l.present,
                 emitter);
        }
    }
}

void narrow_group(const NarrowView& view, const BlockSpans& spans, const SpanGroup& group, Emitter& emitter) {
    for (std::uint32_t i = group.begin; i < group.end; i += kTogether) {
        GroupLights together[kVectors];
        TilePlanes columns[kSmallSpan][kVectors];
        for (std::uint32_t v = 0; v < kVectors; ++v) {
            load_lights(view, spans, i + v * kLanes, group.end, together[v]);
            for (std::uint32_t c = 0; c < group.columns; ++c)
                if (has_planes(planes_in_use(c, group.columns, group.is_clipped)))
                    columns[c][v] = load_planes(view.columns, together[v].column_planes, c);
        }
        for (std::uint32_t r = 0; r < group.rows; ++r) narrow_row(view, group, together, columns, r, emitter);
    }
}

// Of tiles [first, first + lanes) along an axis.
HWY_INLINE TilePlanes load_planes(const AxisPlanes* first) {
    TilePlanes planes;
    hn::LoadInterleaved4(kF, &first->before_offset, planes.before_offset, planes.before_depth, planes.behind_offset,
                         planes.behind_depth);
    return planes;
}

struct LargeLight {
    Spheres along_x, along_y;
    std::uint32_t light, steps;
    std::uint32_t first_x, last_x, first_y, last_y;
    bool narrows; // see narrow_slack
};

HWY_INLINE LargeLight load_light(const SpanSphere& sphere, const SpanTiles& tiles) {
    const Floats x = hn::Set(kF, sphere.x);
    const Floats y = hn::Set(kF, sphere.y);
    const Floats depth = hn::Set(kF, sphere.depth);
    const Floats radius = hn::Set(kF, sphere.radius);
    const Floats slack = narrow_slack(x, y, depth, radius);
    const float sum = hn::GetLane(slack);
    return {{x, depth, radius, slack},
            {y, depth, radius, slack},
            tiles.light,
            tiles.steps,
            tiles.first & 0xFFFF,
            tiles.last & 0xFFFF,
            tiles.first >> 16,
            tiles.last >> 16,
            sum >= 1e-9f * 0x1p-20f && sum <= 4e18f * 0x1p-20f};
}

void cut_rows(const NarrowView& view, const LargeLight& light, const RecordBuffer& buffer) {
    for (std::uint32_t y = light.first_y; y <= light.last_y; y += static_cast<std::uint32_t>(hn::Lanes(kF))) {
        const Cuts rows =
            light.narrows ? cut_tile(light.along_y, load_planes(view.rows + y), {true, true}) : uncut(light.along_y);
        const Spheres caps = light.narrows ? caps_of(light.along_x, rows) : light.along_x;
        hn::StoreU(rows.low, kF, buffer.row_low + (y - light.first_y));
        hn::StoreU(rows.high, kF, buffer.row_high + (y - light.first_y));
        hn::StoreU(caps.depth, kF, buffer.cap_depth + (y - light.first_y));
        hn::StoreU(caps.radius, kF, buffer.cap_radius + (y - light.first_y));
    }
}

// The tiles of one light: its rows, then a vector of columns at a time.
void narrow_large(const NarrowView& view, const LargeLight& light, Emitter& emitter) {
    const RecordBuffer& buffer = emitter.buffer();
    cut_rows(view, light, buffer);
    const Words first_x = hn::Set(kW, light.first_x);
    const Words last_x = hn::Set(kW, light.last_x);
    const Words begin_step = hn::Set(kW, light.steps & 15);
    const Words end_step = hn::Set(kW, light.steps & 240);
    for (std::uint32_t x = light.first_x; x <= light.last_x; x += static_cast<std::uint32_t>(hn::Lanes(kF))) {
        const Words column = hn::Iota(kW, x);
        const Mask present = hn::FirstN(kF, light.last_x - x + 1);
        const TilePlanes planes = load_planes(view.columns + x);
        const Words steps_x = hn::Or(hn::IfThenElseZero(column == first_x, begin_step),
                                     hn::IfThenElse(column == last_x, end_step, hn::Set(kW, view.full_steps << 4)));
        for (std::uint32_t y = light.first_y; y <= light.last_y; ++y) {
            const std::uint32_t r = y - light.first_y;
            const Cuts row = {hn::Set(kF, buffer.row_low[r]), hn::Set(kF, buffer.row_high[r]), hn::Zero(kF),
                              hn::Zero(kF)};
            const Spheres cap = {light.along_x.offset, hn::Set(kF, buffer.cap_depth[r]),
                                 hn::Set(kF, buffer.cap_radius[r]), light.along_x.slack};
            const Cuts cut = light.narrows ? cut_tile(cap, planes, {true, true}) : uncut(cap);
            const std::uint32_t first_step = y == light.first_y ? (light.steps >> 8) & 15 : 0;
            const std::uint32_t last_step = y == light.last_y ? (light.steps >> 8) & 240 : view.full_steps << 4;
            const Records records = {column + hn::Set(kW, view.first_tile + y * view.tiles_x), hn::Set(kW, light.light),
                                     steps_x, hn::Set(kW, first_step | last_step)};
            emit(view, records, cut, row, light.along_x.slack, present, emitter);
        }
    }
}

} // namespace

std::uint64_t narrow_block(const NarrowView& view, const BlockSpans& spans, const RecordBuffer& buffer,
                           RecordPool& pool) {
    Emitter emitter(buffer, pool);
    std::uint32_t begin = 0;
    for (std::uint32_t g = 0; g < kLargeSpan; ++g) {
        const std::uint32_t shape = g % kSpanShapes;
        const SpanGroup group = {begin, spans.ends[g], shape % kSmallSpan + 1, shape / kSmallSpan + 1,
                                 g >= kSpanShapes};
        narrow_group(view, spans, group, emitter);
        begin = spans.ends[g];
    }
    for (std::uint32_t i = begin; i < spans.ends[kLargeSpan]; ++i)
        narrow_large(view, load_light(spans.spheres[spans.order[i]], spans.tiles[spans.order[i]]), emitter);
    return emitter.finish();
}

} // namespace manylights::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manylights::detail {

HWY_EXPORT(narrow_block);

std::uint64_t narrow_block(const NarrowView& view, const BlockSpans& spans, const RecordBuffer& buffer,
                           RecordPool& pool) {
    return HWY_DYNAMIC_DISPATCH(narrow_block)(view, spans, buffer, pool);
}

} // namespace manylights::detail
#endif
