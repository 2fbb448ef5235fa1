// Tiles of pixels, whose samples adaptive films count apart: blocks of the whole film.

import package::gen::{TILE_BLOCK};

// The first pixel of a tile, in the whole film; `tile` is its column, and its row times 2^16, in tiles.
fn tile_corner(tile: u32) -> vec2<u32> {
    return TILE_BLOCK * vec2<u32>(tile & 0xffffu, tile >> 16u);
}

// The pixel of a workgroup's lane, from the first of the tile.
fn place_in_tile(lane: u32) -> vec2<u32> {
    return vec2<u32>(lane % TILE_BLOCK, lane / TILE_BLOCK);
}
