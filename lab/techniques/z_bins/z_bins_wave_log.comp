#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_LOG
#define MANYLIGHTS_WAVE
#include "lab/techniques/z_bins/z_bins.glsl"
