#version 460
// The bounds of each cluster: its cell's box and its patch's cone, or those of its samples.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/cluster.glsl"
#include "lab/techniques/clustered_samples/samples.glsl"
#include "lab/techniques/device/spread.glsl"

layout(constant_id = 0) const bool kIsExplicit = false;

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 3) readonly buffer Keys { uint d[]; } keys;
layout(std430, set = 0, binding = 4) readonly buffer Extents { uint d[]; } extents; // only where explicit
layout(std430, set = 0, binding = 5) writeonly buffer Clusters { Cluster d[]; } clusters;

// Between two slopes of an axis, at the depths from near to far.
vec2 span_between(float low_slope, float high_slope, float near, float far) {
    return vec2(min(low_slope * near, low_slope * far), max(high_slope * near, high_slope * far));
}

// The last slice is open.
Box box_of_cell(uvec2 tile, uint slice) {
    uvec2 first = tile * tile_size, last = min(first + tile_size, view.size) - 1u;
    vec2 size = vec2(view.size);
    float near = slice_edges.d[slice], far = min(slice_edges.d[slice + 1u], 1e30);
    vec2 across = span_between(pixel_edge_slope(first.x, -1.0, view.right.w, size.x, view.reach.x),
                               pixel_edge_slope(last.x, 1.0, view.right.w, size.x, view.reach.x), near, far);
    vec2 down = span_between(pixel_edge_slope(first.y, -1.0, view.down.w, size.y, view.reach.y),
                             pixel_edge_slope(last.y, 1.0, view.down.w, size.y, view.reach.y), near, far);
    return Box(vec4(across.x, down.x, near, 0.0), vec4(across.y, down.y, far, 0.0));
}

float extent(uint cluster, uint word) { return value_of_ordered(extents.d[8u * cluster + word]); }

Box box_of_members(uint cluster) {
    return Box(vec4(-extent(cluster, 0u), -extent(cluster, 1u), -extent(cluster, 2u), 0.0),
               vec4(extent(cluster, 3u), extent(cluster, 4u), extent(cluster, 5u), 0.0));
}

vec4 cone_of(uint cluster, uint number) {
    if (patch_count == 1u || number == kNoPatch) return vec4(0.0, 0.0, 1.0, -1.0);
    vec3 middle = patch_direction(number, vec2(0.5));
    float cosine = kIsExplicit ? -extent(cluster, 6u) - 1e-6 : patch_cosine(number);
    return vec4(dot(view.right.xyz, middle), dot(view.down.xyz, middle), dot(view.forward.xyz, middle), cosine);
}

void main() {
    uint cluster = spread_index(64u);
    if (cluster >= cluster_count) return;
    uint key = keys.d[cluster];
    uint slice = key / patch_count % slice_count, tile = key / patch_count / slice_count;
    Box box = Box(vec4(0.0), vec4(0.0));
    if (kIsExplicit)
        box = box_of_members(cluster);
    else
        box = box_of_cell(uvec2(tile % tiles_x, tile / tiles_x), slice);
    clusters.d[cluster] = Cluster(box, cone_of(cluster, key % patch_count));
}
