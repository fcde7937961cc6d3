#version 460
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/brute_force/brute_force.glsl"
