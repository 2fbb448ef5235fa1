//! What adaptive sampling shares with WGSL: samples by tiles of pixels, and what half of a tile tells of its variance.
//!
//! A tile is a block of [`TILE_BLOCK`](super::trace::TILE_BLOCK) by as many pixels of the whole film.

use glam::{UVec2, Vec3};

gpu_struct! {
    /// One sample of each pixel of a tile: a workgroup of the trace kernel.
    pub struct TileSample {
        /// Column of the tile in the whole film, in tiles, and row times 2^16.
        pub tile: u32,
        /// Film sample.
        pub sample: u32,
    }

    /// Samples of one tile, one after the other: first those of half 0, then those of half 1.
    pub struct TileRun {
        /// As [`TileSample::tile`].
        pub tile: u32,
        /// Index of the first of them.
        pub first: u32,
        /// How many there are of each half.
        pub counts: [u32; 2],
    }

    /// What is noted of half a pixel beside its sums.
    pub struct HalfMark {
        /// Mean radiance of the samples there were when it was last tallied; linear Rec.709.
        pub mean: Vec3,
        /// Rays of all its samples so far, modulo 2^32.
        pub rays: u32,
    }

    /// What is noted of a pixel.
    pub struct PixelMark {
        pub halves: [HalfMark; 2],
    }

    /// Half of a tile that is tallied.
    pub struct TallyRun {
        /// As [`TileSample::tile`].
        pub tile: u32,
        /// 0 or 1.
        pub half: u32,
    }

    /// What half of a tile tells, summed over its pixels in the window.
    pub struct TileTally {
        /// The pixels' means, linear Rec.709.
        pub mean: Vec3,
        /// The number of pixels.
        pub pixels: f32,
        /// The squared difference of a pixel's mean to what it was when it was last tallied, relative to the tile's, over all channels; of each pixel
        /// at most [`MOST_OF_TILE`] times the mean pixel's.
        pub error: f32,
        /// Rays of all its samples.
        pub rays: f32,
        pub pad0: u32,
        pub pad1: u32,
    }

    /// Parameters of the tally pass.
    pub struct TallyParams {
        /// The film's window, in the whole film.
        pub window_x: u32,
        pub window_y: u32,
        pub window_width: u32,
        pub window_height: u32,
        /// How many halves of tiles are tallied.
        pub runs: u32,
        /// 2^-exponent of the film.
        pub scale: f32,
    }
}

gpu_consts! {
    /// Pixels of a tile.
    pub const TILE_LANES: u32 = 64;
    /// Means above this are tallied as this, so that sums of squares stay finite.
    pub const MOST_TALLIED: f32 = 1e18;
    /// What a pixel tells of its tile's variance is at most so many times what the mean pixel does: a rare bright sample is not all of a tile.
    pub const MOST_OF_TILE: f32 = 16.0;
    /// Added to squared radiance, which squared errors are relative to.
    pub const TALLY_DARK: f32 = 0.01;
}

/// A tile of the whole film by column and row, in one word.
pub fn pack_tile(at: UVec2) -> u32 {
    at.x | at.y << 16
}

/// Column and row of a tile.
pub fn unpack_tile(tile: u32) -> UVec2 {
    UVec2::new(tile & 0xffff, tile >> 16)
}
