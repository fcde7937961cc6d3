// The log form of a technique's shader: every lane writes down what it touches, each into a range of its own. A lane's
// place lives in a buffer, so that a later dispatch continues where an earlier one stopped.
//
// Run twice. With all ends at 0 nothing is written, and the places end up as counts; then they are set to where the
// lane's range starts, and the words are written. A place at or beyond its end never writes.
#ifndef MANYLIGHTS_LAB_TOUCH_LOG_GLSL
#define MANYLIGHTS_LAB_TOUCH_LOG_GLSL

#include "lab/techniques/touch_word.h"

layout(std430, set = 0, binding = 1) readonly buffer LogBlocks { uint d[]; }
log_blocks; // the sampled blocks of 8 x 8 pixels, row by row; a workgroup each
layout(std430, set = 0, binding = 2) buffer LogPlaces { uint d[]; }
log_places; // per lane of each sampled block
layout(std430, set = 0, binding = 4) readonly buffer LogEnds { uint d[]; }
log_ends;
layout(std430, set = 0, binding = 5) writeonly buffer LogWords { uint d[]; }
log_words;

uint log_place = 0u, log_end = 0u; // of this lane

void touch(uint kind, uint index) {
    if (log_place < log_end) log_words.d[log_place] = touch_word(kind, index);
    log_place += 1u;
}

void touch_light(uint light) { touch(kTouchTested, light); }
void touch_node(uint unit) { touch(kTouchNode, unit); }
void touch_check(uint reference) { touch(kTouchCheck, reference); }
void touch_batch(uint batch) { touch(kTouchBatch, batch); }

#endif
