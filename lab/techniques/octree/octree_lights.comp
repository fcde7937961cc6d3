#version 460
// The lists of the nodes: an invocation per light goes down the octree, with the nodes on its path for a stack. Run
// twice: lists are counted, then written (counted_lists.h).
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/device/device_view.glsl"
#include "lab/techniques/device/tile_grid.glsl"
#include "lab/techniques/device/visible_light.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Lights { VisibleLight d[]; } lights;
layout(std430, set = 0, binding = 1) buffer Counters { uint d[]; } counters; // lengths, or where the next one goes
layout(std430, set = 0, binding = 2) writeonly buffer References { uint d[]; } references;
layout(push_constant) uniform Push { // of tile_pass.h
    DeviceView view;
    TileGrid grid;
    uint light_count;
    uint is_fill;
};

#include "lab/techniques/octree/octree_place.glsl"

void insert(VisibleLight light, uint node) {
    uint place = atomicAdd(counters.d[node], 1u);
    if (is_fill != 0u) references.d[place] = light.index;
}

// May the light reach a point of the block? Depths of the part of its sphere that is in the pyramid of the block's
// tiles. Of a single tile, as in octree_tiles.glsl, the pyramid's edges are asked as well.
bool reaches(VisibleLight light, uint level, Block block) {
    uvec2 first = first_pixel_of(grid, block.first.xy), last = last_pixel_of(grid, block.last.xy, view.size);
    if (any(lessThan(last_pixel(light), first)) || any(greaterThan(first_pixel(light), last))) return false;
    DepthSpan span = rectangle_depths(view, first, last, light.sphere);
    if (span.low > span.high) return false;
    if (level == 0u && misses_corner(view, first, last, light.sphere)) return false;
    uvec2 slices = slices_of(span);
    return slices.x <= block.last.z && slices.y >= block.first.z;
}

// No node below need be looked at.
bool is_settled(VisibleLight light, uint level, uvec3 at, uint node) {
    if (!has_samples(node)) return true;
    Block block = block_of(level, at);
    if (!reaches(light, level, block)) return true;
    if (!is_stored_at(light, level, block)) return false;
    insert(light, node);
    return true;
}

// To the next node, by octants, on the same level or above; above the root at last.
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
