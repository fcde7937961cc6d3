#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_RECORD
#define ML_COUNTERS
#include "lab/techniques/tree_walk.glsl"
