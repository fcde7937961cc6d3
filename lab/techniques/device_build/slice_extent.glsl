// The depths of a slice that the heuristics assume to be occupied: the first begins at the near plane, and none reaches
// beyond slice_far or the farthest light. The includer brings slice_edges, farthest, near_depth and slice_far.
#ifndef MANYLIGHTS_LAB_SLICE_EXTENT_GLSL
#define MANYLIGHTS_LAB_SLICE_EXTENT_GLSL

vec2 extent_of(uint slice) {
    float end = min(max(slice_far, uintBitsToFloat(farthest.d[0])), 3e38);
    return vec2(max(slice_edges.d[slice], near_depth), min(slice_edges.d[slice + 1u], end));
}

#endif
