#version 460
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/hierarchy_shading.glsl"
