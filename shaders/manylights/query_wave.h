// Which lights may reach the points of a wave? A cursor for compute shaders over the buffers of a view with windows:
// the lanes of a wave test one candidate each against what all of their points cover, and share what is left. Include
// <manylights/query.h> with its accessors first; then
//
//     #include <manylights/query_wave.h>
//
//     MlWaveCursor cursor = ml_wave_begin(view, gl_GlobalInvocationID.xy + 0.5, depth, has_point);
//     uint light;
//     while (ml_wave_next_batch(cursor))        // all lanes together
//         while (ml_wave_next(cursor, light))   // each lane for itself
//             if (ml_affects(point, center(light), range(light))) color += shade(light, point);
//
// A lane without a point (has_point is false: sky, outside of the image) goes through the loops as the others do, tests
// candidates with them and is handed nothing. No light that may reach a lane's point is kept from the lane, and none is
// handed to it twice. What is the same in all lanes, and when:
//
//   the first call of ml_wave_next_batch   in uniform control flow: the lanes active there are the wave. Later some may
//                                          be missing: the candidates that they would have tested go to all lanes
//                                          untested
//   cursor.is_shared                       the same in all lanes. True: ml_wave_next hands the same lights, in the same
//                                          order, to all lanes with a point in the current tile. False: the batch had
//                                          fewer than ML_WAVE_FEW candidates, and each lane has picked its own
//
// ML_WAVE_FEW: 12 if it is not defined, at most 32; with 0 all batches are shared.
//
// Wave operations are those of the language: GLSL needs GL_KHR_shader_subgroup_basic, _ballot and _arithmetic, HLSL
// shader model 6.0. With ML_WAVE_EMULATED they go through workgroup memory instead: the includer defines
//
//     #define ML_WAVE_SIZE 32                  lanes of a wave, 4 to 64: the next so many invocations of the workgroup
//     #define ML_WAVE_GROUP_SIZE 64            invocations of the workgroup, a multiple of it
//     #define ML_WAVE_INDEX gl_LocalInvocationIndex
//     #define ML_WAVE_SHARED(i) words[i]       a uint of workgroup memory, i below ML_WAVE_GROUP_SIZE; for nothing else
//                                              between ml_wave_begin and the end of the outer loop
//
// and every invocation of the workgroup calls ml_wave_next_batch, in uniform control flow, until it is false, which it
// is for all at once. In C++ ML_WAVE_BARRIER() is needed as well.
#if !defined(ML_WAVE_FEW)
#define ML_WAVE_FEW 12u
#endif

#define ML_WAVE_NONE 0xFFFFFFFFu

#include "wave_operations.h"

struct MlWaveCursor {
    // This lane's point.
    MlUint header; // the cell of its tile's header, until it has been handed the tile's lights; then ML_WAVE_NONE
    MlUint code;
    MlUint step_x;
    MlUint step_y;
    bool takes_part; // it lies in the current tile, and in one of its slices
    // The wave's current tile, and the windows of all its points there: the small references, then the large ones.
    MlUint tile_header; // ML_WAVE_NONE behind the last tile
    MlTile tile;
    MlUint small_first; // relative to the tile's first, like large_first
    MlUint small_count;
    MlUint large_first;
    MlUint next; // candidate to be tested
    MlUint count;
    // What the wave's points cover there: the least and the greatest depth code and their slices, which of up to 128
    // equal parts of that range (a bit each), and which steps: x in the low 16 bits, y in the high ones.
    MlUint low_code;
    MlUint high_code;
    MlUint first_slice;
    MlUint last_slice;
    MlUint part_shift;
    MlUint4 parts;
    MlUint places;
    // The current batch: a bit for each candidate that is left to be handed out.
    MlUint batch_first;
    MlUint left_low;
    MlUint left_high;
    bool is_shared;
#if defined(ML_COUNTERS)
    MlUint tested;     // lights handed out to this lane
    MlUint nodes;      // headers and entries read
    MlUint references; // references that this lane read
#endif
};

// Where the point is. position and depth as for ml_begin; neither matters without a point.
ML_FN MlWaveCursor ml_wave_begin(ML_IN(MlView) view, MlFloat2 position, float depth, bool has_point) {
    MlUint x = ml_pixel(position.x, view.width), y = ml_pixel(position.y, view.height);
    MlWaveCursor cursor;
    cursor.header = view.cell_offset + 2u * (y / view.tile_px * view.tiles_x + x / view.tile_px);
    if (!has_point) cursor.header = ML_WAVE_NONE;
    cursor.code = ml_depth_code(depth, view.depth_scale);
    cursor.step_x = ml_tile_step(x % view.tile_px, view.tile_px);
    cursor.step_y = ml_tile_step(y % view.tile_px, view.tile_px);
    cursor.takes_part = false;
    cursor.tile_header = ML_WAVE_NONE;
    cursor.tile.first_reference = cursor.tile.first_entry = cursor.tile.base_code = cursor.tile.form = 0u;
    cursor.small_first = cursor.small_count = cursor.large_first = cursor.next = cursor.count = 0u;
    cursor.low_code = cursor.high_code = cursor.first_slice = cursor.last_slice = 0u;
    cursor.part_shift = cursor.places = 0u;
    cursor.parts.x = cursor.parts.y = cursor.parts.z = cursor.parts.w = 0u;
    cursor.batch_first = cursor.left_low = cursor.left_high = 0u;
    cursor.is_shared = false;
#if defined(ML_COUNTERS)
    cursor.tested = cursor.nodes = cursor.references = 0u;
#endif
    return cursor;
}

// The place of a candidate among the tile's references.
ML_FN MlUint ml_wave_reference(ML_IN(MlWaveCursor) cursor, MlUint candidate) {
    return candidate < cursor.small_count ? cursor.small_first + candidate
                                          : cursor.large_first + (candidate - cursor.small_count);
}

ML_FN MlUint ml_wave_shift(ML_IN(MlWaveCursor) cursor, MlUint candidate) {
    MlTileForm form = ml_tile_form(cursor.tile.form);
    return candidate < cursor.small_count ? form.small_shift : form.large_shift;
}

ML_FN MlWindow ml_wave_window(ML_INOUT(MlWaveCursor) cursor, MlUint slice) {
    MlTileForm form = ml_tile_form(cursor.tile.form);
#if defined(ML_COUNTERS)
    if (form.flat_count == 0u) cursor.nodes += 1u;
#endif
    return ml_read_window(cursor.tile, form, slice);
}

// All that is in the window of any slice between the first and the last: windows' ends never go back.
ML_FN void ml_wave_read_windows(ML_INOUT(MlWaveCursor) cursor) {
    MlTileForm form = ml_tile_form(cursor.tile.form);
    cursor.first_slice = (cursor.low_code - cursor.tile.base_code) >> form.slice_shift;
    cursor.last_slice = (cursor.high_code - cursor.tile.base_code) >> form.slice_shift;
    MlWindow first = ml_wave_window(cursor, cursor.first_slice);
    MlWindow last = first;
    if (cursor.last_slice != cursor.first_slice) last = ml_wave_window(cursor, cursor.last_slice);
    cursor.small_first = first.small_first;
    cursor.small_count = last.small_last - first.small_first;
    cursor.large_first = first.large_first;
    cursor.count = cursor.small_count;
    if (form.two_classes != 0u) cursor.count += last.large_last - first.large_first;
}

// The next tile in which a lane has a point. is_due: this wave has done with its last one; where it has not, it only
// takes part in the operations of those waves that have.
ML_FN void ml_wave_next_tile(ML_INOUT(MlWaveCursor) cursor, bool is_due) {
    if (is_due && cursor.header == cursor.tile_header) cursor.header = ML_WAVE_NONE;
    MlUint header = ml_wave_min(cursor.header);
    MlTile tile = cursor.tile;
    if (is_due && header != ML_WAVE_NONE) tile = ml_tile_from_cells(ML_CELL(header), ML_CELL(header + 1u));
    MlTileForm form = ml_tile_form(tile.form);
    bool is_here = cursor.header == header && header != ML_WAVE_NONE && tile.form != 0u;
    bool takes_part = is_here && cursor.code >= tile.base_code &&
                      (cursor.code - tile.base_code) >> form.slice_shift <= form.last_slice;
    MlUint low = ml_wave_min(takes_part ? cursor.code : ML_WAVE_NONE);
    MlUint high = ~ml_wave_min(takes_part ? ~cursor.code : ML_WAVE_NONE);
    if (!is_due) return;
    cursor.tile_header = header;
    cursor.tile = tile;
    cursor.takes_part = takes_part;
    cursor.low_code = low;
    cursor.high_code = high;
    cursor.next = cursor.count = 0u;
#if defined(ML_COUNTERS)
    if (header != ML_WAVE_NONE) cursor.nodes += 1u;
#endif
    if (low != ML_WAVE_NONE) ml_wave_read_windows(cursor);
}

// What the points cover, by the operations of all lanes; once more the same for a wave that has gathered it before.
ML_FN void ml_wave_gather(ML_INOUT(MlWaveCursor) cursor) {
    MlUint shift = 0u;
    while ((cursor.high_code - cursor.low_code) >> shift > 127u) shift += 1u;
    MlUint part = (cursor.code - cursor.low_code) >> shift;
    MlUint word = cursor.takes_part ? part >> 5u : ML_WAVE_NONE;
    MlUint bit = 1u << (part & 31u);
    cursor.part_shift = shift;
    cursor.parts.x = ml_wave_or(word == 0u ? bit : 0u);
    cursor.parts.y = ml_wave_or(word == 1u ? bit : 0u);
    cursor.parts.z = ml_wave_or(word == 2u ? bit : 0u);
    cursor.parts.w = ml_wave_or(word == 3u ? bit : 0u);
    cursor.places = ml_wave_or(cursor.takes_part ? (1u << cursor.step_x) | (0x10000u << cursor.step_y) : 0u);
}

// The slice in which a candidate begins, or the wave's first one where it begins before: the first one whose window
// ends behind it.
ML_FN MlUint ml_wave_slice(ML_INOUT(MlWaveCursor) cursor, MlUint candidate) {
    MlUint first = cursor.first_slice, last = cursor.last_slice;
    MlUint reference = ml_wave_reference(cursor, candidate);
    while (first < last) {
        MlUint middle = (first + last) >> 1u;
        MlWindow window = ml_wave_window(cursor, middle);
        bool is_in = reference < (candidate < cursor.small_count ? window.small_last : window.large_last);
        first = is_in ? first : middle + 1u;
        last = is_in ? middle : last;
    }
    return first;
}

// Parts of the wave's depths, ends included; first is greater than last where there is none.
struct MlWaveParts {
    MlUint first;
    MlUint last;
};

ML_FN MlWaveParts ml_wave_make_parts(MlUint first, MlUint last) {
    MlWaveParts parts;
    parts.first = first;
    parts.last = last;
    return parts;
}

// Which parts a candidate may reach. Its bounds say where it begins modulo 256 units, and its slice the rest. Units are
// counted from that of the wave's least depth.
ML_FN MlWaveParts ml_wave_parts(ML_IN(MlWaveCursor) cursor, MlUint bounds, MlUint shift, MlUint slice) {
    MlUint slice_shift = ml_tile_form(cursor.tile.form).slice_shift;
    if ((1u << slice_shift) >> shift > 254u) return ml_wave_make_parts(0u, 127u); // so long a slice does not tell
    MlUint begin = cursor.tile.base_code + (slice << slice_shift);
    MlUint zero = cursor.low_code >> shift;
    bool is_first = slice == cursor.first_slice;
    MlUint unit = is_first ? zero : begin >> shift;
    MlUint distance = (bounds - unit) & 255u;
    MlUint from = unit - zero + distance;
    MlUint to = from + ((bounds >> 8u) & 255u);
    if (is_first) {
        // What has begun before the wave may reach the least of its depths, where there is a point, or ends before it.
        if (to >= 256u) return ml_wave_make_parts(0u, 0u);
        MlUint last_in_slice = ((begin + (1u << slice_shift) - 1u) >> shift) - zero;
        if (distance > last_in_slice) return ml_wave_make_parts(1u, 0u);
    }
    MlUint last_unit = (cursor.high_code >> shift) - zero;
    if (from > last_unit) return ml_wave_make_parts(1u, 0u);
    to = to < last_unit ? to : last_unit;
    MlUint first = from == 0u ? 0u : (((zero + from) << shift) - cursor.low_code) >> cursor.part_shift;
    MlUint last = (((zero + to + 1u) << shift) - 1u - cursor.low_code) >> cursor.part_shift;
    return ml_wave_make_parts(first, last < 127u ? last : 127u);
}

// The bits of the parts in the word that begins with a part.
ML_FN MlUint ml_wave_part_bits(ML_IN(MlWaveParts) parts, MlUint begin) {
    if (parts.first > begin + 31u || parts.last < begin) return 0u;
    MlUint first = parts.first > begin ? parts.first - begin : 0u;
    MlUint last = parts.last < begin + 31u ? parts.last - begin : 31u;
    return (ML_WAVE_NONE << first) & (ML_WAVE_NONE >> (31u - last));
}

ML_FN bool ml_wave_has_parts(ML_IN(MlWaveCursor) cursor, ML_IN(MlWaveParts) parts) {
    return ((cursor.parts.x & ml_wave_part_bits(parts, 0u)) | (cursor.parts.y & ml_wave_part_bits(parts, 32u)) |
            (cursor.parts.z & ml_wave_part_bits(parts, 64u)) | (cursor.parts.w & ml_wave_part_bits(parts, 96u))) != 0u;
}

ML_FN MlUint ml_wave_bounds(ML_INOUT(MlWaveCursor) cursor, MlUint candidate) {
#if defined(ML_COUNTERS)
    cursor.references += 1u;
#endif
    return ML_REFERENCE(2u * (cursor.tile.first_reference + ml_wave_reference(cursor, candidate)) + 1u);
}

// May a candidate's light reach any of the wave's points?
ML_FN bool ml_wave_may_reach(ML_INOUT(MlWaveCursor) cursor, MlUint candidate) {
    MlUint bounds = ml_wave_bounds(cursor, candidate);
    MlUint columns = (0xFFFFu << ((bounds >> 16u) & 15u)) & (0xFFFFu >> (15u - ((bounds >> 20u) & 15u)));
    MlUint rows = (0xFFFFu << ((bounds >> 24u) & 15u)) & (0xFFFFu >> (15u - (bounds >> 28u)));
    if ((cursor.places & columns) == 0u || (cursor.places >> 16u & rows) == 0u) return false;
    MlUint slice = ml_wave_slice(cursor, candidate);
    return ml_wave_has_parts(cursor, ml_wave_parts(cursor, bounds, ml_wave_shift(cursor, candidate), slice));
}

// Few candidates: each lane compares its own point with all of them.
ML_FN void ml_wave_pick(ML_INOUT(MlWaveCursor) cursor) {
    cursor.left_low = cursor.left_high = 0u;
    for (MlUint i = 0u; cursor.next + i < cursor.count; ++i) {
        MlUint candidate = cursor.next + i;
        MlUint depth = cursor.code >> ml_wave_shift(cursor, candidate);
        MlUint bounds = ml_wave_bounds(cursor, candidate);
        if (ml_bounds_hold(bounds, depth, cursor.step_x, cursor.step_y)) cursor.left_low |= 1u << i;
    }
}

// Each lane tests one candidate for all. A lane that is not there denies none. size: of the batch, up to 64.
ML_FN void ml_wave_cull(ML_INOUT(MlWaveCursor) cursor, MlUint size) {
    bool is_denied = false;
    if (cursor.is_shared && ML_WAVE_LANE < size) is_denied = !ml_wave_may_reach(cursor, cursor.next + ML_WAVE_LANE);
    MlUint low, high;
    ml_wave_ballot(is_denied, low, high);
    if (!cursor.is_shared) return;
    cursor.left_low = ~low & (size < 32u ? (1u << size) - 1u : ML_WAVE_NONE);
    cursor.left_high = size <= 32u ? 0u : ~high & (ML_WAVE_NONE >> (64u - size));
}

// The next candidates. False: there are none left for any lane. With emulated waves: of the workgroup.
ML_FN bool ml_wave_next_batch(ML_INOUT(MlWaveCursor) cursor) {
    bool is_due = cursor.next >= cursor.count;
    if (ml_wave_group_any(is_due)) ml_wave_next_tile(cursor, is_due);
    if (!ml_wave_group_any(cursor.tile_header != ML_WAVE_NONE)) return false;
    MlUint size = cursor.count - cursor.next;
    cursor.is_shared = size > 0u && size >= MlUint(ML_WAVE_FEW);
    if (cursor.is_shared && size > ML_WAVE_SIZE) size = ML_WAVE_SIZE;
    if (cursor.is_shared && size > 64u) size = 64u;
    if (ml_wave_group_any(is_due && cursor.is_shared)) ml_wave_gather(cursor);
    if (!cursor.is_shared) ml_wave_pick(cursor);
    if (ml_wave_group_any(cursor.is_shared)) ml_wave_cull(cursor, size);
    cursor.batch_first = cursor.next;
    cursor.next += size;
    return true;
}

// The batch's next light that may reach the point of this lane. False: there is none left in the batch.
ML_FN bool ml_wave_next(ML_INOUT(MlWaveCursor) cursor, ML_OUT(MlUint) light) {
    light = 0u;
    if (!cursor.takes_part || (cursor.left_low | cursor.left_high) == 0u) return false;
    MlUint candidate = cursor.batch_first;
    if (cursor.left_low != 0u) {
        candidate += ml_lowest_bit(cursor.left_low);
        cursor.left_low &= cursor.left_low - 1u;
    } else {
        candidate += 32u + ml_lowest_bit(cursor.left_high);
        cursor.left_high &= cursor.left_high - 1u;
    }
    light = ML_REFERENCE(2u * (cursor.tile.first_reference + ml_wave_reference(cursor, candidate)));
#if defined(ML_COUNTERS)
    cursor.tested += 1u;
#endif
    return true;
}
