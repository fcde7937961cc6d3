#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_FRAGMENT
#include "lab/techniques/hybrid_lighting/hybrid_lists.glsl"
