#version 460
// The table of all corners of froxels.
#extension GL_GOOGLE_include_directive : require
#define FROXEL_BINDING 0
#include "lab/techniques/device/device_view.glsl"
#include "lab/techniques/device/froxel_grid.glsl"
#include "lab/techniques/device/spread.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 1) writeonly buffer Corners { vec4 d[]; } corners;
layout(push_constant) uniform Push {
    DeviceView view;
    uint corner_count;
};

#include "lab/techniques/octree/octree_corner.glsl"

void main() {
    uint i = spread_index(64u);
    if (i >= corner_count) return;
    uint across = froxels.tiles.tiles.x + 1u, column = i / froxels.slice_count;
    corners.d[i] = vec4(computed_corner(uvec3(column % across, column / across, i % froxels.slice_count)), 1.0);
}
