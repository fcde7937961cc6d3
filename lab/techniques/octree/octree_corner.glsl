// Corners of froxels, in the camera's axes. The includer brings the view and froxel_grid.glsl.
#ifndef MANYLIGHTS_LAB_OCTREE_CORNER_GLSL
#define MANYLIGHTS_LAB_OCTREE_CORNER_GLSL

// Not of the plane behind the last slice, which is nowhere.
vec3 computed_corner(uvec3 vertex) {
    uvec2 pixel = min(first_pixel_of(froxels.tiles, vertex.xy), view.size);
    precise vec2 slope = (vec2(pixel) - 0.5 * vec2(view.size)) / vec2(view.right.w, view.down.w);
    precise vec3 corner = vec3(slope, 1.0) * froxels.edges[vertex.z];
    return corner;
}

uint corner_index(uvec3 vertex) {
    return (vertex.y * (froxels.tiles.tiles.x + 1u) + vertex.x) * froxels.slice_count + vertex.z;
}

#endif
