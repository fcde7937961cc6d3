// Rectangles drawn as two triangles of six vertices. Their corners are whole texels, half a texel from the nearest
// centre, so rounding moves none of these across an edge; each is drawn once.
#ifndef MANYLIGHTS_LAB_RECTANGLE_GLSL
#define MANYLIGHTS_LAB_RECTANGLE_GLSL

// Where a vertex is, of the rectangle of texels from `first` to before `end`, in an image of `size` texels.
vec4 rectangle_vertex(int vertex, uvec2 first, uvec2 end, uvec2 size) {
    bool is_right = vertex == 1 || vertex == 2 || vertex == 4;
    bool is_low = vertex == 2 || vertex == 4 || vertex == 5;
    vec2 corner = vec2(is_right ? end.x : first.x, is_low ? end.y : first.y);
    return vec4(2.0 * corner / vec2(size) - 1.0, 0.0, 1.0);
}

#endif
