// The links of light_linked_list.h, as they lie in the pool:
//
//   words   bytes   what
//   2       8       halves: least depth in the upper 16 bits, greatest below; rank of the light in view in the upper 8
//                   bits, next link below
//   3       12      halves; light; next link
//   4       16      least depth; greatest depth; light; next link
//
// The pool is several buffers, pages of 2^23 links: of the longest, as much as every device can bind. The includer says
// from which binding on they are (POOL_BINDING) and what it does to them (POOL_ACCESS).
#ifndef MANYLIGHTS_LAB_LIGHT_LINKS_GLSL
#define MANYLIGHTS_LAB_LIGHT_LINKS_GLSL

#include "lab/techniques/light_linked_list/half_depths.h"

const uint kNoLink = 0xFFFFFFFFu;
const uint kNoShortLink = 0xFFFFFFu; // in 24 bits
const uint kPageBits = 23u;

#define POOL_PAGE(page, Block, name)                                                                                   \
    layout(std430, set = 0, binding = POOL_BINDING + page) POOL_ACCESS buffer Block { uint d[]; } name;
POOL_PAGE(0, Pool0, pool0)
POOL_PAGE(1, Pool1, pool1)
POOL_PAGE(2, Pool2, pool2)
POOL_PAGE(3, Pool3, pool3)
POOL_PAGE(4, Pool4, pool4)
POOL_PAGE(5, Pool5, pool5)
POOL_PAGE(6, Pool6, pool6)
POOL_PAGE(7, Pool7, pool7)

// Where a link is in its page.
uint first_word(uint link, uint link_words) { return (link & ((1u << kPageBits) - 1u)) * link_words; }

#endif
