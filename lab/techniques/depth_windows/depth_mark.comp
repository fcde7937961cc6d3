#version 460
#extension GL_GOOGLE_include_directive : require
// Which references may a shaded point of their tile be handed? One workgroup per tile.
//
// The tile's points are entered into bins of depth codes, and of each bin it is kept at which of the sixteen steps
// across and down it has points. A reference is needed where the codes of the slices whose windows hold it meet a bin
// with points, its bounds hold a code of that part of the bin, and its rectangle meets the bin's steps both ways. That is
// the cursor's own test (ml_begin_tile, ml_bounds_hold) on the same integers, made for a bin of points at once: it
// confirms what the cursor confirms for one of them, and nothing is decoded that the cursor does not know.
#include "lab/techniques/depth_windows/depth_tile.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 2) readonly buffer References { uint d[]; } references;
layout(std430, set = 0, binding = 3) readonly buffer Positions { vec4 d[]; } positions;
layout(std430, set = 0, binding = 4) writeonly buffer Kept { uint d[]; } kept;    // 1 or 0, and a 0 behind the last
layout(std430, set = 0, binding = 5) writeonly buffer Spans { uvec2 d[]; } spans; // first and last slice with points
layout(push_constant) uniform Push { uint reference_count; };

const uint kLanes = 64u;
const uint kBins = 256u;

shared uint first_code, last_code; // of the points; first is behind last where there is none
shared uint bins[kBins];           // bits 0 to 15: steps across with points, 16 to 31: steps down

// A point of the tile, as its cursor sees it; without depth where no window serves it.
struct TilePoint {
    bool is_served;
    uint code;
    uvec2 steps;
};

uvec2 tile_origin() { return gl_WorkGroupID.xy * views.d[0].tile_px; }

uvec2 tile_size() {
    uvec2 image = uvec2(views.d[0].width, views.d[0].height);
    return min(image - tile_origin(), uvec2(views.d[0].tile_px));
}

TilePoint tile_point(SourceTile source, uint pixel) {
    uint columns = tile_size().x;
    uvec2 place = uvec2(pixel % columns, pixel / columns);
    uvec2 coordinates = tile_origin() + place;
    float depth = positions.d[coordinates.y * views.d[0].width + coordinates.x].w;
    TilePoint point;
    point.code = ml_depth_code(depth, views.d[0].depth_scale);
    uint slice = (point.code - source.tile.base_code) >> source.form.slice_shift;
    point.is_served = depth > 0.0 && point.code >= source.tile.base_code && slice <= source.form.last_slice;
    point.steps = uvec2(ml_tile_step(place.x, views.d[0].tile_px), ml_tile_step(place.y, views.d[0].tile_px));
    return point;
}

void find_codes(SourceTile source, uint pixel_count) {
    uint least = 0xFFFFFFFFu, greatest = 0u;
    for (uint pixel = gl_LocalInvocationIndex; pixel < pixel_count; pixel += kLanes) {
        TilePoint point = tile_point(source, pixel);
        if (!point.is_served) continue;
        least = min(least, point.code);
        greatest = max(greatest, point.code);
    }
    atomicMin(first_code, least);
    atomicMax(last_code, greatest);
}

void fill_bins(SourceTile source, uint pixel_count, uint shift) {
    for (uint pixel = gl_LocalInvocationIndex; pixel < pixel_count; pixel += kLanes) {
        TilePoint point = tile_point(source, pixel);
        if (!point.is_served) continue;
        atomicOr(bins[(point.code - first_code) >> shift], (1u << point.steps.x) | (65536u << point.steps.y));
    }
}

// The window of the reference's class.
uvec2 window_of(SourceTile source, uint reference, uint slice) {
    MlWindow window = ml_read_window(source.tile, source.form, slice);
    bool is_small = reference < source.small_count;
    return is_small ? uvec2(window.small_first, window.small_last) : uvec2(window.large_first, window.large_last);
}

// Those of the slices with points whose windows hold the reference; the first is behind the last where none does. They
// are in a row, for the ends of windows never go back: they begin where windows end behind the reference, and end with
// the last window that does not begin behind it.
uvec2 slices_with(SourceTile source, uint reference, uvec2 span) {
    if (window_of(source, reference, span.x).x > reference || window_of(source, reference, span.y).y <= reference)
        return uvec2(1u, 0u);
    uint first = span.x, end = span.y;
    while (first < end) {
        uint middle = (first + end) / 2u;
        if (window_of(source, reference, middle).y > reference)
            end = middle;
        else
            first = middle + 1u;
    }
    uint last = first;
    end = span.y + 1u;
    while (last + 1u < end) {
        uint middle = (last + end) / 2u;
        if (window_of(source, reference, middle).x <= reference)
            last = middle;
        else
            end = middle;
    }
    return uvec2(first, last);
}

// Do the bounds hold one of the depths [near, far], in units of the reference's class? Either they hold the first, or
// the next one that they hold is not behind the last.
bool bounds_meet(uint bounds, uint near, uint far) {
    uint begun = (near - bounds) & 255u;
    return begun <= ((bounds >> 8u) & 255u) || begun + (far - near) >= 256u;
}

// The steps of the rectangle, as in bins.
bool rectangle_meets(uint bounds, uint bin) {
    uint across = (2u << ((bounds >> 20u) & 15u)) - (1u << ((bounds >> 16u) & 15u));
    uint down = (2u << (bounds >> 28u)) - (1u << ((bounds >> 24u) & 15u));
    return (bin & across) != 0u && ((bin >> 16u) & down) != 0u;
}

bool is_needed(SourceTile source, uint reference, uvec2 span, uint bin_shift) {
    uvec2 slices = slices_with(source, reference, span);
    if (slices.x > slices.y) return false;
    uint near = max(source.tile.base_code + (slices.x << source.form.slice_shift), first_code);
    uint far = min(source.tile.base_code + ((slices.y + 1u) << source.form.slice_shift) - 1u, last_code);
    uint bounds = references.d[2u * (source.tile.first_reference + reference) + 1u];
    uint unit_shift = reference < source.small_count ? source.form.small_shift : source.form.large_shift;
    for (uint bin = (near - first_code) >> bin_shift; bin <= (far - first_code) >> bin_shift; ++bin) {
        if (!rectangle_meets(bounds, bins[bin])) continue;
        uint bin_near = max(near, first_code + (bin << bin_shift));
        uint bin_far = min(far, first_code + ((bin + 1u) << bin_shift) - 1u);
        if (bounds_meet(bounds, bin_near >> unit_shift, bin_far >> unit_shift)) return true;
    }
    return false;
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint index = gl_WorkGroupID.y * views.d[0].tiles_x + gl_WorkGroupID.x;
    SourceTile source = source_tile(index);
    uint pixel_count = source.reference_count != 0u ? tile_size().x * tile_size().y : 0u;
    if (lane == 0u) {
        first_code = 0xFFFFFFFFu;
        last_code = 0u;
    }
    for (uint bin = lane; bin < kBins; bin += kLanes) bins[bin] = 0u;
    barrier();
    find_codes(source, pixel_count);
    barrier();
    uint bin_shift = 0u;
    while (first_code <= last_code && (last_code - first_code) >> bin_shift >= kBins) bin_shift += 1u;
    fill_bins(source, pixel_count, bin_shift);
    barrier();
    bool has_points = first_code <= last_code;
    uvec2 span = (uvec2(first_code, last_code) - source.tile.base_code) >> source.form.slice_shift;
    for (uint reference = lane; reference < source.reference_count; reference += kLanes)
        kept.d[source.tile.first_reference + reference] =
            has_points && is_needed(source, reference, span, bin_shift) ? 1u : 0u;
    if (lane != 0u) return;
    spans.d[index] = span;
    if (index == 0u) kept.d[reference_count] = 0u;
}
