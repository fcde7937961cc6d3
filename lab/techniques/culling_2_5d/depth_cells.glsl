// The cells of a tile's depths: one function for points and lights, so that integers decide.
#ifndef MANYLIGHTS_LAB_DEPTH_CELLS_GLSL
#define MANYLIGHTS_LAB_DEPTH_CELLS_GLSL

// Never descends with the depth, whatever the tile: a difference and a product are rounded, and rounding keeps the
// order. scale: x the tile's least depth, y cells per unit of depth, divided once per tile and read by all. Where all
// points have one depth it is 0, and everything is in cell 0; what is not a number is there as well.
uint depth_cell(float depth, vec2 scale, uint cell_count) {
    precise float place = (depth - scale.x) * scale.y;
    if (!(place > 0.0)) return 0u;
    return place < float(cell_count) ? uint(place) : cell_count - 1u;
}

// A bit per cell, of 64.
uvec2 cell_bit(uint cell) { return cell < 32u ? uvec2(1u << cell, 0u) : uvec2(0u, 1u << (cell - 32u)); }

// Of the cells before one, up to 64 of them.
uvec2 bits_below(uint cell) {
    return uvec2(cell >= 32u ? 0xFFFFFFFFu : (1u << cell) - 1u,
                 cell >= 64u ? 0xFFFFFFFFu : (cell > 32u ? (1u << (cell - 32u)) - 1u : 0u));
}

// first is not behind last.
uvec2 cell_bits(uint first, uint last) { return bits_below(last + 1u) & ~bits_below(first); }

#endif
