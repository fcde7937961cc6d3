// A link of a list of lights: tile_links.h. 8 bytes.
#ifndef MANYLIGHTS_LAB_LIGHT_LINK_GLSL
#define MANYLIGHTS_LAB_LIGHT_LINK_GLSL

struct LightLink {
    uint light;
    uint next; // kNoLink behind the last
};

const uint kNoLink = 0xFFFFFFFFu;

#endif
