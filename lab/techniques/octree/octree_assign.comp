#version 460
// The lists of the nodes: a light is stored in the froxels with samples that it may reach, or in a node above them where
// it reaches all of the node's froxels. An invocation per light goes down the octree, with the nodes on its path for a
// stack. Run twice: lists are counted, then written (counted_lists.h).
#extension GL_GOOGLE_include_directive : require
#define FROXEL_BINDING 3
#define OCTREE_BINDING 4
#include "lab/techniques/device/device_view.glsl"
#include "lab/techniques/device/visible_light.glsl"
#include "lab/techniques/octree/octree.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kHasInner = 1u;
layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 1) buffer Counters { uint d[]; } counters; // lengths, or where the next one goes
layout(std430, set = 0, binding = 2) writeonly buffer References { uint d[]; } references;
layout(push_constant) uniform Push {
    DeviceView view;
    uint light_count;
    uint is_fill;
};

#include "lab/techniques/octree/octree_core.glsl"

void insert(VisibleLight light, uint node) {
    uint place = atomicAdd(counters.d[node], 1u);
    if (is_fill != 0u) references.d[place] = light.index;
}

// Froxels of a node that are in the grid: first and last.
struct Block {
    uvec3 first, last;
};

Block block_of(uint level, uvec3 at) {
    Block block;
    block.first = at << level;
    block.last = min((at + 1u) << level, uvec3(froxels.tiles.tiles, froxels.slice_count)) - 1u;
    return block;
}

// May the light reach a point of the block? Depths of the part of its sphere that is in the pyramid of the block's
// tiles; a slice holds its lower edge.
bool reaches(VisibleLight light, Block block) {
    uvec2 first = first_pixel_of(froxels.tiles, block.first.xy);
    uvec2 last = last_pixel_of(froxels.tiles, block.last.xy, view.size);
    if (any(lessThan(last_pixel(light), first)) || any(greaterThan(first_pixel(light), last))) return false;
    DepthSpan span = rectangle_depths(view, first, last, light.sphere);
    if (span.low > span.high) return false;
    uvec2 slices = slices_of(span);
    return slices.x <= block.last.z && slices.y >= block.first.z;
}

// Whether the light's node is found: no node below need be looked at.
bool is_settled(VisibleLight light, uint level, uvec3 at, uint node) {
    if (!has_samples(node)) return true;
    Block block = block_of(level, at);
    if (!reaches(light, block)) return true;
    if (level > 0u && (kHasInner == 0u || !holds_core(light.sphere, block.first, block.last))) return false;
    insert(light, node);
    return true;
}

// The nearest of the following nodes, by octants, that is on the same level or above; above the root at last.
void leave(inout uint level, inout uvec3 at) {
    while (level < root_level() && (at & 1u) == uvec3(1u)) {
        level += 1u;
        at >>= 1u;
    }
    if (level == root_level()) {
        level += 1u;
        return;
    }
    uint octant = octant_of(at) + 1u;
    at = (at & ~1u) | (uvec3(octant, octant >> 1u, octant >> 2u) & 1u);
}

bool is_in_grid(uint level, uvec3 at) { return all(lessThan(at, octree.levels[level].xyz)); }

void main() {
    if (gl_GlobalInvocationID.x >= light_count) return;
    VisibleLight light = lights.d[gl_GlobalInvocationID.x];
    uint path[kMostLevels];
    uint level = root_level();
    uvec3 at = uvec3(0u);
    path[level] = root_node();
    while (level <= root_level()) {
        if (!is_in_grid(level, at) || is_settled(light, level, at, path[level])) {
            leave(level, at);
        } else {
            level -= 1u;
            at <<= 1u;
        }
        if (level < root_level()) path[level] = child_of(path[level + 1u], level, at);
    }
}
