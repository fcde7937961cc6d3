// More workgroups than an axis allows, in two axes: spread_groups of spread.h.
#ifndef MANYLIGHTS_LAB_SPREAD_GLSL
#define MANYLIGHTS_LAB_SPREAD_GLSL

uint spread_group() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
// lanes: of a workgroup.
uint spread_index(uint lanes) { return spread_group() * lanes + gl_LocalInvocationIndex; }

#endif
