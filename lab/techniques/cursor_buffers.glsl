// A structure in the library's format and the library's query over it, which says what it touches.
#ifndef MANYLIGHTS_LAB_CURSOR_BUFFERS_GLSL
#define MANYLIGHTS_LAB_CURSOR_BUFFERS_GLSL

#include "lab/techniques/structure_accessors.glsl"

// The second word of a reference of windows is what a point is compared with.
uint touched_reference(uint i) {
    if (views.d[0].structure == ML_STRUCTURE_WINDOWS && (i & 1u) != 0u) touch_check(i >> 1u);
    return references.d[i];
}

#define ML_REFERENCE(i) touched_reference(i)
#include <manylights/query.h>

#endif
