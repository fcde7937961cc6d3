// Rectangles drawn as two triangles of six vertices. Where their corners are whole texels, half a texel from the nearest
// centre, rounding moves none of these across an edge; each is drawn once.
#ifndef MANYLIGHTS_LAB_RECTANGLE_GLSL
#define MANYLIGHTS_LAB_RECTANGLE_GLSL

// Where a vertex is, of the rectangle of texels from `first` to before `end`, in an image of `size` texels. In the middle
// of the clip volume's depths, so that no rectangle is clipped.
vec4 rectangle_vertex(int vertex, vec2 first, vec2 end, vec2 size) {
    bool is_right = vertex == 1 || vertex == 2 || vertex == 4;
    bool is_low = vertex == 2 || vertex == 4 || vertex == 5;
    vec2 corner = vec2(is_right ? end.x : first.x, is_low ? end.y : first.y);
    return vec4(2.0 * corner / size - 1.0, 0.5, 1.0);
}

#endif
