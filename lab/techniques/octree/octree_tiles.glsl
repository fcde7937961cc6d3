// The lists of the nodes: a light in a tile goes down the nodes above the tile's froxels (Lamecki, Kaczmarek,
// Porter-Sobieraj: a fragment of the light's billboard). tile_lists.glsl brings the buffers and calls `visit`.
#include "lab/techniques/octree/octree_place.glsl"

// Of all tiles of a node, the one that stores a light which reaches all of the node's froxels, so that it is stored once:
// the first that has pixels. The light goes over that tile, for it reaches it.
uvec2 storing_tile(Block block) { return tile_of(froxels.tiles, first_pixel_of(froxels.tiles, block.first.xy)); }

// No node below need be looked at. slices: that the light reaches in the tile.
bool is_settled(VisibleLight light, uvec2 tile, uvec2 slices, uint level, uint along, uint node) {
    if (!has_samples(node)) return true;
    Block block = block_of(level, uvec3(tile >> level, along));
    if (slices.x > block.last.z || slices.y < block.first.z) return true;
    if (!is_stored_at(light, level, block)) return false;
    if (tile == storing_tile(block)) add_light(node, light.index);
    return true;
}

// To the next node towards the far end, on the same level or above; above the root at last.
void leave(inout uint level, inout uint along) {
    while (level < root_level() && (along & 1u) == 1u) {
        level += 1u;
        along >>= 1u;
    }
    if (level == root_level())
        level += 1u;
    else
        along += 1u;
}

void visit(VisibleLight light, uvec2 tile) {
    DepthSpan depths = depths_in_tile(light, tile);
    if (depths.low > depths.high || misses_tile(light, tile)) return;
    uvec2 slices = slices_of(depths);
    uint path[kMostLevels];
    uint level = root_level(), along = 0u;
    path[level] = root_node();
    while (level <= root_level()) {
        bool is_in_grid = along < octree.levels[level].z;
        if (!is_in_grid || is_settled(light, tile, slices, level, along, path[level])) {
            leave(level, along);
        } else {
            level -= 1u;
            along <<= 1u;
        }
        if (level < root_level()) path[level] = child_of(path[level + 1u], level, uvec3(tile >> level, along));
    }
}
