//! The tiles that a film's window touches.

use glam::UVec2;

use crate::layout::adaptive::pack_tile;
use crate::layout::trace::TILE_BLOCK;

/// Tiles row by row from the top left: blocks of the whole film, which a window may cut.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// The first tile, in tiles.
    first: UVec2,
    /// Columns and rows.
    size: UVec2,
    /// Pixels of each tile that are in the window; at least 1.
    pub pixels: Vec<u32>,
}

impl Grid {
    /// Of a window of the whole film, by its first pixel and its size.
    pub fn of(min: UVec2, size: UVec2) -> Self {
        let (first, end) = (min / TILE_BLOCK, (min + size).map(|end| end.div_ceil(TILE_BLOCK)));
        let within = |tile: u32, from: u32, to: u32| to.min((tile + 1) * TILE_BLOCK) - from.max(tile * TILE_BLOCK);
        let row = |y: u32| {
            let height = within(y, min.y, min.y + size.y);
            (first.x..end.x).map(move |x| within(x, min.x, min.x + size.x) * height)
        };
        let pixels = match size.min_element() {
            0 => Vec::new(),
            _ => (first.y..end.y).flat_map(row).collect(),
        };
        Self { first, size: end - first, pixels }
    }

    /// How many tiles there are.
    pub fn len(&self) -> usize {
        self.pixels.len()
    }

    pub fn is_empty(&self) -> bool {
        self.pixels.is_empty()
    }

    /// Pixels of the window.
    pub fn all_pixels(&self) -> u64 {
        self.pixels.iter().map(|pixels| u64::from(*pixels)).sum()
    }

    /// A tile as kernels know it.
    pub fn packed(&self, tile: usize) -> u32 {
        pack_tile(self.first + self.place(tile))
    }

    /// The tiles around one.
    pub fn around(&self, tile: usize) -> impl Iterator<Item = usize> + '_ {
        let at = self.place(tile);
        let near = |at: u32, size: u32| at.saturating_sub(1)..(at + 2).min(size);
        let all = near(at.y, self.size.y).flat_map(move |y| near(at.x, self.size.x).map(move |x| (x, y)));
        all.map(|(x, y)| (y * self.size.x + x) as usize).filter(move |other| *other != tile)
    }

    fn place(&self, tile: usize) -> UVec2 {
        UVec2::new(tile as u32 % self.size.x, tile as u32 / self.size.x)
    }
}
