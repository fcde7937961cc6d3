// Directions in 54 parts: the faces of a cube along the world's axes, each in 3 x 3 patches; and one more part.
#ifndef MANYLIGHTS_LAB_NORMAL_PATCH_GLSL
#define MANYLIGHTS_LAB_NORMAL_PATCH_GLSL

const uint kNoPatch = 54u; // of what has no direction, or none that floats tell: it may face anything

float greatest_part(vec3 normal) { return max(max(abs(normal.x), abs(normal.y)), abs(normal.z)); }

uint patch_of(vec3 normal) {
    float greatest = greatest_part(normal);
    if (!(greatest > 1e-30 && greatest < 1e30)) return kNoPatch;
    vec3 direction = normal / greatest;
    vec3 size = abs(direction);
    uint axis = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
    uint side = direction[axis] < 0.0 ? 1u : 0u;
    vec2 place = vec2(direction[(axis + 1u) % 3u], direction[(axis + 2u) % 3u]);
    uvec2 cell = min(uvec2(clamp(1.5 * (place + 1.0), 0.0, 3.0)), uvec2(2u));
    return (2u * axis + side) * 9u + cell.y * 3u + cell.x;
}

// Any vector with a patch, of unit length.
vec3 unit_normal(vec3 normal) { return normalize(normal / greatest_part(normal)); }

// The direction at a place of the patch, each coordinate from 0 to 1.
vec3 patch_direction(uint number, vec2 place) {
    uint axis = number / 18u, cell = number % 9u;
    vec2 across = (vec2(cell % 3u, cell / 3u) + place) / 1.5 - 1.0;
    vec3 direction = vec3(0.0);
    direction[axis] = number / 9u % 2u == 0u ? 1.0 : -1.0;
    direction[(axis + 1u) % 3u] = across.x;
    direction[(axis + 2u) % 3u] = across.y;
    return normalize(direction);
}

// No direction of the patch is farther from its middle: a cap that holds the corners holds what is between them. A normal
// may be in a patch that it is 2^-22 beside.
float patch_cosine(uint number) {
    vec3 middle = patch_direction(number, vec2(0.5));
    float least = 1.0;
    for (uint corner = 0u; corner < 4u; ++corner)
        least = min(least, dot(middle, patch_direction(number, vec2(corner & 1u, corner >> 1u))));
    return least - 1e-5;
}

#endif
