// What the last two passes of depth mode hand on about a tile.
#ifndef MANYLIGHTS_LAB_DEPTH_SHAPE_GLSL
#define MANYLIGHTS_LAB_DEPTH_SHAPE_GLSL

struct TileShape {
    uint base_code;
    uint form;        // 0 where no reference is left
    uint first_slice; // of the source, to last_slice: 2^merge of them make one
    uint last_slice;
    uint merge;
};

#endif
