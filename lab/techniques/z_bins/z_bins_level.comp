#version 460
// Hands the spans of one level down to the level below: each is two of half its length.

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) buffer Levels { uvec2 d[]; } levels;
layout(push_constant) uniform Push {
    uint bin_count;
    uint level; // from 1 on: the one above
};

void main() {
    uint bin = gl_GlobalInvocationID.x;
    if (bin >= bin_count) return;
    uint above = level * bin_count, below = above - bin_count, half_span = 1u << (level - 1u);
    uvec2 ranks = min(levels.d[below + bin], levels.d[above + bin]);
    if (bin >= half_span) ranks = min(ranks, levels.d[above + bin - half_span]);
    levels.d[below + bin] = ranks;
}
