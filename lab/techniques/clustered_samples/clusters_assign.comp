#version 460
// The lights of each cluster: a workgroup of 32 lanes goes down the hierarchy, a lane per child. Run twice: to count, and
// to write to the places that the counts leave.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/cluster.glsl"
#include "lab/techniques/device/spread.glsl"

layout(constant_id = 0) const bool kIsWriting = false;

layout(local_size_x = 32) in;
layout(std430, set = 0, binding = 0) readonly buffer Shapes { HierarchyShape d[]; } shapes;
layout(std430, set = 0, binding = 1) readonly buffer Nodes { Box d[]; } nodes;
layout(std430, set = 0, binding = 2) readonly buffer Spheres { vec4 d[]; } spheres;
layout(std430, set = 0, binding = 3) readonly buffer Clusters { Cluster d[]; } clusters;
layout(std430, set = 0, binding = 4) buffer Counts { uint d[]; } counts; // when writing: their sums
layout(std430, set = 0, binding = 5) readonly buffer Indices { uint d[]; } indices;
layout(std430, set = 0, binding = 6) writeonly buffer Ranges { uvec2 d[]; } ranges;
layout(std430, set = 0, binding = 7) writeonly buffer References { uint d[]; } references;
layout(push_constant) uniform Push { uint cluster_count; };

const uint kLanes = 32u;
const uint kLevelShift = 28u;
const uint kNothing = 0xFFFFFFFFu;

// Nodes to go down to: the level in the upper bits. Deeper ones are above. Those of a level are pushed only when fewer than
// kLanes / fan_out of them and below are there, and all these are taken: so never more than kLanes of each level.
shared uint stack[kLanes * kMaxLevels];
shared uint entered, found; // a bit for each lane

uint taken_of(uint size) { return min(size, kLanes / shapes.d[0].fan_out); }

// The child of the lane, with its level; kNothing where there is none. size: of the stack.
uint child_of(uint size, uint lane) {
    uint fan_out = shapes.d[0].fan_out, slot = lane / fan_out;
    if (slot >= taken_of(size)) return kNothing;
    uint node = stack[size - taken_of(size) + slot];
    uint level = (node >> kLevelShift) - 1u;
    uint child = (node & ((1u << kLevelShift) - 1u)) * fan_out + lane % fan_out;
    return child < shapes.d[0].levels[level].y ? level << kLevelShift | child : kNothing;
}

bool meets(uint child, Cluster cluster) {
    uint level = child >> kLevelShift, index = child & ((1u << kLevelShift) - 1u);
    if (level != 0u) return boxes_meet(nodes.d[shapes.d[0].levels[level].x + index], cluster.box);
    return sphere_meets_box(spheres.d[index], cluster.box) && may_be_in_front(spheres.d[index], cluster);
}

void main() {
    uint lane = gl_LocalInvocationIndex, number = spread_group();
    if (number >= cluster_count) return; // the whole workgroup
    Cluster cluster = clusters.d[number];
    uint below = (1u << lane) - 1u;
    uint first = kIsWriting ? counts.d[number] : 0u, total = 0u;
    if (lane == 0u) stack[0] = shapes.d[0].level_count << kLevelShift; // its children are the highest level
    for (uint size = 1u; size > 0u;) {
        if (lane == 0u) entered = found = 0u;
        barrier();
        uint child = child_of(size, lane);
        bool is_met = child != kNothing && meets(child, cluster);
        bool is_light = is_met && child >> kLevelShift == 0u, is_node = is_met && !is_light;
        if (is_node) atomicOr(entered, 1u << lane);
        if (is_light) atomicOr(found, 1u << lane);
        barrier();
        size -= taken_of(size);
        if (is_node) stack[size + bitCount(entered & below)] = child;
        if (kIsWriting && is_light) references.d[first + total + bitCount(found & below)] = indices.d[child];
        size += bitCount(entered);
        total += bitCount(found);
        barrier();
    }
    if (lane != 0u) return;
    if (kIsWriting)
        ranges.d[number] = uvec2(first, first + total);
    else
        counts.d[number] = total;
}
