#version 460
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/depth_windows_wave/depth_windows_wave.glsl"
