#version 460
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/light_volumes/light_volumes.glsl"
