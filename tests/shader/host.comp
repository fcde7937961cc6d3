#version 450
// The smallest compute shader that uses all of the shader library, as GLSL.
#extension GL_GOOGLE_include_directive : require
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

void main() {
    MlView view = views.d[0];
    if (gl_GlobalInvocationID.x >= view.width || gl_GlobalInvocationID.y >= view.height) return;
    uint pixel = gl_GlobalInvocationID.y * view.width + gl_GlobalInvocationID.x;
    vec4 point = points.d[pixel];
    uint affecting = 0u;
    uint light;
    MlCursor cursor = ml_begin(view, vec2(gl_GlobalInvocationID.xy) + 0.5, point.w);
    while (ml_next(cursor, light))
        if (ml_affects(point.xyz, lights.d[light].xyz, lights.d[light].w)) affecting += 1u;
    // A second cursor while the first one lives, left early.
    MlCursor first = ml_begin(view, vec2(0.5), 1.0);
    if (ml_next(first, light)) affecting += light;
#if defined(ML_COUNTERS)
    affecting += cursor.tested + cursor.nodes + cursor.references;
#endif
    results.d[pixel] = affecting;
}
