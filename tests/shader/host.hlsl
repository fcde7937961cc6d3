// The smallest compute shader that uses all of the shader library, as HLSL.
#define ML_HLSL
#include "manylights/format.h"

StructuredBuffer<MlView> views : register(t0);
StructuredBuffer<float> slice_edges : register(t1);
StructuredBuffer<MlCell> cells : register(t2);
StructuredBuffer<uint4> nodes : register(t3);
StructuredBuffer<uint> references : register(t4);
StructuredBuffer<float4> lights : register(t5);
StructuredBuffer<float4> points : register(t6); // xyz relative to the camera, view depth
RWStructuredBuffer<uint> results : register(u0);

#define ML_SLICE_EDGE(i) slice_edges[i]
#define ML_CELL(i) cells[i]
#define ML_NODE(i) ml_node_from_words(nodes[i])
#define ML_REFERENCE(i) references[i]
#include "manylights/query.h"

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    MlView view = views[0];
    if (id.x >= view.width || id.y >= view.height) return;
    uint pixel = id.y * view.width + id.x;
    float4 position = points[pixel];
    uint affecting = 0u;
    uint light;
    MlCursor cursor = ml_begin(view, float2(id.xy) + 0.5, position.w);
    while (ml_next(cursor, light)) {
        float4 sphere = lights[light];
        if (ml_affects(position.xyz, sphere.xyz, sphere.w)) affecting += 1u;
    }
    // A second cursor while the first one lives, left early.
    MlCursor first = ml_begin(view, float2(0.5, 0.5), 1.0);
    if (ml_next(first, light)) affecting += light;
#if defined(ML_COUNTERS)
    affecting += cursor.tested + cursor.nodes + cursor.references;
#endif
    results[pixel] = affecting;
}
