// The wave cursor with lanes whose points lie anywhere, and with lanes that have none, are missing or leave early.
#include <manylights/format.h>
#include "reference/oracle/light_hash.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kWaveSize = 64u;
layout(constant_id = 1) const uint kFew = 12u;
layout(std430, set = 0, binding = 0) readonly buffer Views { MlView d[]; } views;
layout(std430, set = 0, binding = 1) readonly buffer SliceEdges { float d[]; } slice_edges;
layout(std430, set = 0, binding = 2) readonly buffer Cells { MlCell d[]; } cells;
layout(std430, set = 0, binding = 3) readonly buffer Nodes { uvec4 d[]; } nodes;
layout(std430, set = 0, binding = 4) readonly buffer References { uint d[]; } references;
layout(std430, set = 0, binding = 5) readonly buffer Spheres { vec4 d[]; } spheres;
layout(std430, set = 0, binding = 6) readonly buffer Positions { vec4 d[]; } positions;
layout(std430, set = 0, binding = 7) readonly buffer Lanes { uvec2 d[]; } lanes; // pixel and what the lane does
layout(std430, set = 0, binding = 8) writeonly buffer Found { uvec2 d[]; } found; // lights and the sum of their hashes
layout(push_constant) uniform Push { uint width; } push;

#define ML_SLICE_EDGE(i) slice_edges.d[i]
#define ML_CELL(i) cells.d[i]
#define ML_NODE(i) ml_node_from_words(nodes.d[i])
#define ML_REFERENCE(i) references.d[i]
#include <manylights/query.h>

#if defined(ML_WAVE_EMULATED)
shared uint wave_words[64];
#define ML_WAVE_SIZE kWaveSize
#define ML_WAVE_GROUP_SIZE 64u
#define ML_WAVE_INDEX gl_LocalInvocationIndex
#define ML_WAVE_SHARED(i) wave_words[i]
#endif
#define ML_WAVE_FEW kFew
#include <manylights/query_wave.h>

const uint kHasPoint = 0u, kIsMissing = 2u, kLeaves = 3u; // 1: takes part without a point

void main() {
    uvec2 lane = lanes.d[gl_GlobalInvocationID.x];
    if (lane.y == kIsMissing) return;
    vec4 point = positions.d[lane.x];
    vec2 place = vec2(lane.x % push.width, lane.x / push.width) + 0.5;
    bool has_point = lane.y != 1u && point.w > 0.0;
    MlWaveCursor cursor = ml_wave_begin(views.d[0], place, point.w, has_point);
    uint light;
    uvec2 sum = uvec2(0u);
    while (ml_wave_next_batch(cursor)) {
        if (lane.y == kLeaves) break;
        while (ml_wave_next(cursor, light))
            if (ml_affects(point.xyz, spheres.d[light].xyz, spheres.d[light].w)) sum += uvec2(1u, light_hash_a(light));
    }
    found.d[gl_GlobalInvocationID.x] = sum;
}
