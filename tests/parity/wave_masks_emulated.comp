#version 460
#extension GL_GOOGLE_include_directive : require
#define ML_WAVE_EMULATED
#include "tests/parity/wave_masks.glsl"
