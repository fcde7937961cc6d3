// Tiles of an image: tile_grid.h says what the members are.
#ifndef MANYLIGHTS_LAB_TILE_GRID_GLSL
#define MANYLIGHTS_LAB_TILE_GRID_GLSL

struct TileGrid {
    uvec2 tiles;
    uvec2 span;
};

uint tile_index(TileGrid grid, uvec2 tile) { return tile.y * grid.tiles.x + tile.x; }

uvec2 tile_of(TileGrid grid, uvec2 pixel) { return pixel * grid.tiles / grid.span; }

uvec2 first_pixel_of(TileGrid grid, uvec2 tile) { return (tile * grid.span + grid.tiles - 1u) / grid.tiles; }

// Within the image. Of an empty tile it is before the first.
uvec2 last_pixel_of(TileGrid grid, uvec2 tile, uvec2 image) {
    return min(first_pixel_of(grid, tile + 1u), image) - 1u;
}

#endif
