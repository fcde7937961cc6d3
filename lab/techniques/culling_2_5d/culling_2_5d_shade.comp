#version 460
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/culling_2_5d/culling_2_5d.glsl"
