#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_RECORD
#define MANYLIGHTS_LINKED
#include "lab/techniques/device/froxel_lists.glsl"
