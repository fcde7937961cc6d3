// What the shaders of light volumes have in common. Bindings before 6 are those of shaded_pixel.glsl.
#ifndef MANYLIGHTS_LAB_VOLUMES_GLSL
#define MANYLIGHTS_LAB_VOLUMES_GLSL

#include "lab/techniques/device/device_view.glsl"

layout(constant_id = 0) const uint kShape = 0u; // what is drawn
const uint kMesh = 0u, kRectangle = 1u, kImage = 2u;

layout(push_constant) uniform Push {
    DeviceView view;
    float mesh_reach; // of proxy_mesh.h
    uint group;       // of lights that are drawn
};

#endif
