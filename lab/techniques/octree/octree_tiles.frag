#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_FRAGMENT
#include "lab/techniques/device/tile_lists.glsl"
#include "lab/techniques/octree/octree_tiles.glsl"
