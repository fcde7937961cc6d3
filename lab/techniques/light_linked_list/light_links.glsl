// The links of light_linked_list.h, as they lie in the pool:
//
//   words   bytes   what
//   2       8       halves: least depth in the upper 16 bits, greatest below; rank of the light in view in the upper 8
//                   bits, next link below
//   3       12      halves; light; next link
//   4       16      least depth; greatest depth; light; next link
#ifndef MANYLIGHTS_LAB_LIGHT_LINKS_GLSL
#define MANYLIGHTS_LAB_LIGHT_LINKS_GLSL

#include "lab/techniques/light_linked_list/half_depths.h"

const uint kNoLink = 0xFFFFFFFFu;
const uint kNoShortLink = 0xFFFFFFu; // in 24 bits

#endif
