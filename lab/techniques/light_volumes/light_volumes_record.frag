#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_RECORD
#include "lab/techniques/light_volumes/light_volumes.glsl"
