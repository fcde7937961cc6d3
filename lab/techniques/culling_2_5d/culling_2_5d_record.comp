#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_RECORD
#include "lab/techniques/culling_2_5d/culling_2_5d.glsl"
