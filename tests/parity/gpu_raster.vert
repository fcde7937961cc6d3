#version 460
// Rectangles, two triangles each, counter-clockwise on the image unless their corners are given the other way round.
layout(std430, set = 0, binding = 0) readonly buffer Rectangles { vec4 d[]; } rectangles; // two corners, in pixels
layout(push_constant) uniform Push {
    vec2 size;
    float depth;
};
layout(location = 0) flat out uint instance;

void main() {
    vec4 corners = rectangles.d[gl_InstanceIndex];
    bool is_right = gl_VertexIndex == 2 || gl_VertexIndex == 3 || gl_VertexIndex == 5;
    bool is_low = gl_VertexIndex == 1 || gl_VertexIndex == 2 || gl_VertexIndex == 5;
    vec2 corner = vec2(is_right ? corners.z : corners.x, is_low ? corners.w : corners.y);
    gl_Position = vec4(2.0 * corner / size - 1.0, depth, 1.0);
    instance = uint(gl_InstanceIndex);
}
