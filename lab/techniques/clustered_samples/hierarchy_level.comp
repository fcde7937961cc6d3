#version 460
// The boxes of a level's nodes, each around its children's: of level 0, the lights' spheres.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/hierarchy.glsl"
#include "lab/techniques/device/spread.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Shapes { HierarchyShape d[]; } shapes;
layout(std430, set = 0, binding = 1) readonly buffer Spheres { vec4 d[]; } spheres;
layout(std430, set = 0, binding = 2) buffer Nodes { Box d[]; } nodes;
layout(push_constant) uniform Push { uint level; };

void main() {
    uint node = spread_index(64u);
    uvec2 own = shapes.d[0].levels[level], below = shapes.d[0].levels[level - 1u];
    if (node >= own.y) return;
    uint first = node * shapes.d[0].fan_out;
    Box box = Box(vec4(kFarthest), vec4(-kFarthest));
    for (uint child = first; child < min(first + shapes.d[0].fan_out, below.y); ++child) {
        Box inner = Box(vec4(0.0), vec4(0.0));
        if (level == 1u)
            inner = box_of_sphere(spheres.d[child]);
        else
            inner = nodes.d[below.x + child];
        box = Box(min(box.low, inner.low), max(box.high, inner.high));
    }
    nodes.d[own.x + node] = box;
}
