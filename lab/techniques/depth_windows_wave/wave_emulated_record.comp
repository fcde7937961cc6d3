#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_RECORD
#define ML_COUNTERS
#define ML_WAVE_EMULATED
#include "lab/techniques/depth_windows_wave/depth_windows_wave.glsl"
