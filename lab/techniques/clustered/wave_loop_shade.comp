#version 460
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered/wave_loop.glsl"
