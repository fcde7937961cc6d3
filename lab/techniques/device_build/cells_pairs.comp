#version 460
// A pair of cell and rank for every reference, light after light, and how many references each cell has. An invocation
// per pair, so that a light in many cells takes no longer than many lights: it looks for the light whose pairs its own
// is among.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/spread.glsl"
#include "lab/techniques/device/tile_grid.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    TileGrid grid;
    uint slice_count;
    uint light_count;
    uint pair_count;
};
layout(std430, set = 0, binding = 2) readonly buffer SliceEdges { float d[]; } slice_edges;
#define SLICE_EDGE(i) slice_edges.d[i]
#include "lab/techniques/device_build/light_cells.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 1) readonly buffer Order { uint d[]; } order;
layout(std430, set = 0, binding = 3) readonly buffer Places { uint d[]; } places; // of the first pair, by rank
layout(std430, set = 0, binding = 4) writeonly buffer Cells { uint d[]; } cells;
layout(std430, set = 0, binding = 5) writeonly buffer Ranks { uint d[]; } ranks;
layout(std430, set = 0, binding = 6) buffer CellCounts { uint d[]; } cell_counts;

// Every light in view has a pair, so that places ascend.
uint rank_of(uint pair) {
    uint rank = 0u, end = light_count;
    while (end - rank > 1u) {
        uint middle = (rank + end) / 2u;
        if (places.d[middle] <= pair)
            rank = middle;
        else
            end = middle;
    }
    return rank;
}

void main() {
    uint pair = spread_index(64u);
    if (pair >= pair_count) return;
    uint rank = rank_of(pair);
    uint cell = cell_in(cells_of(lights.d[order.d[rank]]), pair - places.d[rank]);
    cells.d[pair] = cell;
    ranks.d[pair] = rank;
    atomicAdd(cell_counts.d[cell], 1u);
}
