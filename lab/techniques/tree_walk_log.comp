#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_LOG
#include "lab/techniques/tree_walk.glsl"
