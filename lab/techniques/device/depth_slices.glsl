// The slice of a depth, by the table of depth_slices.h. The includer brings SLICE_EDGE(i).
#ifndef MANYLIGHTS_LAB_DEPTH_SLICES_GLSL
#define MANYLIGHTS_LAB_DEPTH_SLICES_GLSL

// Never descends with the depth. Depths in front of the camera's plane are in the first slice.
uint slice_of(float depth, uint slice_count) {
    uint slice = 0u, end = slice_count;
    while (end - slice > 1u) {
        uint middle = (slice + end) / 2u;
        if (depth >= SLICE_EDGE(middle))
            slice = middle;
        else
            end = middle;
    }
    return slice;
}

#endif
