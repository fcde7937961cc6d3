// What the two shaders see that enter lights into the lists.
#ifndef MANYLIGHTS_LAB_LIGHT_LINKS_BUILD_GLSL
#define MANYLIGHTS_LAB_LIGHT_LINKS_BUILD_GLSL

#include "lab/techniques/device/device_view.glsl"
#include "lab/techniques/device/tile_grid.glsl"
#include "lab/techniques/device/visible_light.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; }
lights;
layout(push_constant) uniform Push {
    DeviceView view;
    TileGrid grid; // of texels
    uint link_words;
    uint capacity; // links
};

#endif
