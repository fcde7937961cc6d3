// What a lane touches while it finds its lights, a 32-bit word each: three bits of kind, 29 bits of index. One text for
// C++ and GLSL: shaders write such words (touch_log.glsl), the host makes unions of them (wave_cost.h).
#ifndef MANYLIGHTS_LAB_TOUCH_WORD_H
#define MANYLIGHTS_LAB_TOUCH_WORD_H

#include <manylights/format.h>

#if defined(__cplusplus)
namespace manylights::lab {
#endif

const MlUint kTouchLane = 0u;      // the lane has a point to shade; index 0
const MlUint kTouchTested = 1u;    // a light, by its index: fetched, and compared with the point
const MlUint kTouchAffecting = 2u; // a light that passed
const MlUint kTouchNode = 3u;      // 16 bytes of a node, by their place in units of 16 bytes: a wide node has several
const MlUint kTouchCheck = 4u;     // a reference read and compared with the point before its light is tested
const MlUint kTouchBatch = 5u;     // candidates that a wave culls together, by the batch's number within the wave
const MlUint kTouchKinds = 6u;

const MlUint kTouchIndexBits = 29u;
const MlUint kTouchTooLarge = 0xFFFFFFFFu; // stands for an index of more bits: the host refuses it

ML_FN MlUint touch_word(MlUint kind, MlUint index) {
    return index >> kTouchIndexBits == 0u ? kind << kTouchIndexBits | index : kTouchTooLarge;
}

#if defined(__cplusplus)
} // namespace manylights::lab
#endif

#endif
