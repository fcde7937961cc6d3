// A light in view, as visible_lights.h hands it to the passes that build. 32 bytes.
#ifndef MANYLIGHTS_LAB_VISIBLE_LIGHT_GLSL
#define MANYLIGHTS_LAB_VISIBLE_LIGHT_GLSL

struct VisibleLight {
    vec4 sphere;  // in the camera's axes; w: culling radius
    uint index;   // of the light
    uint columns; // of pixels: first, and last in the upper 16 bits
    uint rows;
    uint unused;
};

uvec2 first_pixel(VisibleLight light) { return uvec2(light.columns, light.rows) & 0xFFFFu; }
uvec2 last_pixel(VisibleLight light) { return uvec2(light.columns, light.rows) >> 16u; }

#endif
