// The samples of the view, and the key of each one's cluster: its tile, its slice of depths, and the part of all
// directions that its normal is in, each in mixed radix, so that keys are dense.
#ifndef MANYLIGHTS_LAB_SAMPLES_GLSL
#define MANYLIGHTS_LAB_SAMPLES_GLSL

#include "lab/techniques/clustered_samples/normal_patch.glsl"
#include "lab/techniques/device/device_view.glsl"

struct PointNormal {
    vec3 normal;
    uint material;
};

layout(std430, set = 0, binding = 0) readonly buffer Positions { vec4 d[]; } positions;
layout(std430, set = 0, binding = 1) readonly buffer Normals { PointNormal d[]; } normals;
layout(std430, set = 0, binding = 2) readonly buffer SliceEdges { float d[]; } slice_edges;
layout(push_constant) uniform Push { // SamplesPush of sample_clusters.h
    DeviceView view;
    uint tile_size, tiles_x;
    uint slice_count;
    uint patch_count;   // 1: normals do not matter
    uint cluster_count; // of passes over clusters
};

#define SLICE_EDGE(i) slice_edges.d[i]
#include "lab/techniques/device/depth_slices.glsl"

struct ViewSample {
    bool is_shaded; // inside of the image, and not sky
    uint index;
    vec4 position; // relative to the camera along the world's axes; w: depth
};

ViewSample sample_at(uvec2 pixel) {
    ViewSample found;
    bool is_inside = all(lessThan(pixel, view.size));
    found.index = is_inside ? pixel.y * view.size.x + pixel.x : 0u;
    found.position = positions.d[found.index];
    found.is_shaded = is_inside && found.position.w > 0.0;
    return found;
}

// Within its tile.
uint local_key(ViewSample found) {
    uint patch_of_sample = patch_count > 1u ? patch_of(normals.d[found.index].normal) : 0u;
    return slice_of(found.position.w, slice_count) * patch_count + patch_of_sample;
}

uint key_of(uvec2 pixel, ViewSample found) {
    uvec2 tile = pixel / tile_size;
    return (tile.y * tiles_x + tile.x) * slice_count * patch_count + local_key(found);
}

#endif
