#version 460
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/light_linked_list/light_linked_list.glsl"
