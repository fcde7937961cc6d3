// Two hashes of a light's index. Their wrapping sums over the lights that affect a point identify the set, whatever
// order the lights came in: a lost light, a light too many and a light handed out twice all change both sums. One text
// for C++ and GLSL, so that the oracle on the CPU and every technique on a device sum the same numbers.
//
// Each is a bijection of 32-bit words (odd multiplications and xor-shifts only), so two lights never share a value.
#ifndef MANYLIGHTS_ORACLE_LIGHT_HASH_H
#define MANYLIGHTS_ORACLE_LIGHT_HASH_H

#include <manylights/format.h>

#if defined(__cplusplus)
namespace manylights {
#endif

ML_FN MlUint light_hash_a(MlUint light) {
    MlUint h = light + 0x9E3779B9u;
    h = (h ^ (h >> 16u)) * 0x21F0AAADu;
    h = (h ^ (h >> 15u)) * 0x735A2D97u;
    return h ^ (h >> 15u);
}

ML_FN MlUint light_hash_b(MlUint light) {
    MlUint h = light ^ 0x5BF03635u;
    h = (h ^ (h >> 17u)) * 0xED5AD4BBu;
    h = (h ^ (h >> 11u)) * 0xAC4C1B51u;
    h = (h ^ (h >> 15u)) * 0x31848BABu;
    return h ^ (h >> 14u);
}

#if defined(__cplusplus)
} // namespace manylights
#endif

#endif
