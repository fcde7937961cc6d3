#version 460
// The billboards of the lights in view: an instance each.
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_VERTEX
#define TILE_PASS_WORD unused
#include "lab/techniques/device/tile_pass.glsl"

layout(location = 0) flat out uint light_number;

void main() {
    light_number = gl_InstanceIndex;
    gl_Position = billboard_vertex(lights.d[light_number], gl_VertexIndex, true);
}
