#version 460
// The pairs of cell and rank in another order.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/spread.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Numbers { uint d[]; } numbers; // of the pair that comes to each place
layout(std430, set = 0, binding = 1) readonly buffer Cells { uint d[]; } cells;
layout(std430, set = 0, binding = 2) readonly buffer Ranks { uint d[]; } ranks;
layout(std430, set = 0, binding = 3) writeonly buffer OrderedCells { uint d[]; } ordered_cells;
layout(std430, set = 0, binding = 4) writeonly buffer OrderedRanks { uint d[]; } ordered_ranks;
layout(push_constant) uniform Push { uint pair_count; };

void main() {
    uint pair = spread_index(64u);
    if (pair >= pair_count) return;
    ordered_cells.d[pair] = cells.d[numbers.d[pair]];
    ordered_ranks.d[pair] = ranks.d[numbers.d[pair]];
}
