#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_RECORD
#define ML_COUNTERS
#define MANYLIGHTS_STEPS
#include "lab/techniques/clustered/wave_loop.glsl"
