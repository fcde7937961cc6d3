// The smallest compute shader that uses the wave cursor, as HLSL.
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

#if defined(ML_WAVE_EMULATED)
groupshared uint words[64];
static uint invocation;
#define ML_WAVE_SIZE 32u
#define ML_WAVE_GROUP_SIZE 64u
#define ML_WAVE_INDEX invocation
#define ML_WAVE_SHARED(i) words[i]
#endif
#include "manylights/query_wave.h"

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID, uint index : SV_GroupIndex) {
#if defined(ML_WAVE_EMULATED)
    invocation = index;
#endif
    MlView view = views[0];
    bool has_point = id.x < view.width && id.y < view.height;
    uint pixel = has_point ? id.y * view.width + id.x : 0u;
    float4 position = points[pixel];
    uint affecting = 0u;
    uint light;
    MlWaveCursor cursor = ml_wave_begin(view, float2(id.xy) + 0.5, position.w, has_point);
    while (ml_wave_next_batch(cursor)) {
        while (ml_wave_next(cursor, light)) {
            float4 sphere = lights[light];
            if (ml_affects(position.xyz, sphere.xyz, sphere.w)) affecting += 1u;
        }
    }
#if defined(ML_COUNTERS)
    affecting += cursor.tested + cursor.nodes + cursor.references;
#endif
    if (has_point) results[pixel] = affecting;
}
