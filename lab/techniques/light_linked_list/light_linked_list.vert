#version 460
// A light's rectangle: the texels under its pixels as a whole, so that each has its centre inside.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/rectangle.glsl"
#include "lab/techniques/light_linked_list/light_links_build.glsl"

layout(location = 0) flat out uint rank;

void main() {
    VisibleLight light = lights.d[gl_InstanceIndex];
    gl_Position = rectangle_vertex(gl_VertexIndex, vec2(tile_of(grid, first_pixel(light))),
                                   vec2(tile_of(grid, last_pixel(light)) + 1u), vec2(grid.tiles));
    rank = uint(gl_InstanceIndex);
}
