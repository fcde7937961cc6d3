#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_RECORD
#include "lab/techniques/octree/octree_shading.glsl"
