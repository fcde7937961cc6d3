#version 450
// The smallest compute shader that uses the wave cursor, as GLSL.
#extension GL_GOOGLE_include_directive : require
#if !defined(ML_WAVE_EMULATED)
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#endif
#include <manylights/format.h>

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, set = 0, binding = 0) readonly buffer Views { MlView d[]; } views;
layout(std430, set = 0, binding = 1) readonly buffer SliceEdges { float d[]; } slice_edges;
layout(std430, set = 0, binding = 2) readonly buffer Cells { MlCell d[]; } cells;
layout(std430, set = 0, binding = 3) readonly buffer Nodes { MlUint4 d[]; } nodes;
layout(std430, set = 0, binding = 4) readonly buffer References { uint d[]; } references;
layout(std430, set = 0, binding = 5) readonly buffer Lights { vec4 d[]; } lights;
layout(std430, set = 0, binding = 6) readonly buffer Points { vec4 d[]; } points; // xyz relative to the camera, view depth
layout(std430, set = 0, binding = 7) writeonly buffer Results { uint d[]; } results;

#define ML_SLICE_EDGE(i) slice_edges.d[i]
#define ML_CELL(i) cells.d[i]
#define ML_NODE(i) ml_node_from_words(nodes.d[i])
#define ML_REFERENCE(i) references.d[i]
#include <manylights/query.h>

#if defined(ML_WAVE_EMULATED)
shared uint words[64];
#define ML_WAVE_SIZE 32u
#define ML_WAVE_GROUP_SIZE 64u
#define ML_WAVE_INDEX gl_LocalInvocationIndex
#define ML_WAVE_SHARED(i) words[i]
#endif
#include <manylights/query_wave.h>

void main() {
    MlView view = views.d[0];
    uvec2 place = gl_GlobalInvocationID.xy;
    bool has_point = place.x < view.width && place.y < view.height;
    uint pixel = has_point ? place.y * view.width + place.x : 0u;
    vec4 point = points.d[pixel];
    uint affecting = 0u;
    uint light;
    MlWaveCursor cursor = ml_wave_begin(view, vec2(place) + 0.5, point.w, has_point);
    while (ml_wave_next_batch(cursor))
        while (ml_wave_next(cursor, light))
            if (ml_affects(point.xyz, lights.d[light].xyz, lights.d[light].w)) affecting += 1u;
#if defined(ML_COUNTERS)
    affecting += cursor.tested + cursor.nodes + cursor.references;
#endif
    if (has_point) results.d[pixel] = affecting;
}
