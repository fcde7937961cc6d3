// Square tiles of an image: tile_grid.h says what the members are.
#ifndef MANYLIGHTS_LAB_TILE_GRID_GLSL
#define MANYLIGHTS_LAB_TILE_GRID_GLSL

struct TileGrid {
    uint tile_size;
    uint tiles_x, tiles_y;
};

uint tile_index(TileGrid grid, uvec2 tile) { return tile.y * grid.tiles_x + tile.x; }

uvec2 first_pixel_of(TileGrid grid, uvec2 tile) { return tile * grid.tile_size; }

// Within the image.
uvec2 last_pixel_of(TileGrid grid, uvec2 tile, uvec2 image) {
    return min((tile + 1u) * grid.tile_size, image) - 1u;
}

#endif
