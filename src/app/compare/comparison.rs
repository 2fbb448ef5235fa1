//! Two pictures, and all that is known about how they differ.

use glam::{IVec2, UVec2};

use crate::image::Pixel;
use crate::stats::blocks::Blocks;
use crate::stats::metrics::{Census, Difference, comparable};

/// Whether FLIP is built in.
pub const HAS_FLIP: bool = cfg!(feature = "flip");

/// Side of the smallest block, pixels.
pub const LEAST_SIDE: u32 = 8;

/// One of the two pictures, as far as it is compared.
#[derive(Debug)]
pub struct Side {
    pub name: String,
    pub pixels: Vec<Pixel>,
    pub census: Census,
}

/// All that is known about the two.
#[derive(Debug)]
pub struct Comparison {
    /// Pixels compared.
    pub size: UVec2,
    /// The first of them, in what --crop counts.
    pub origin: IVec2,
    pub a: Side,
    pub b: Side,
    pub difference: Difference,
    pub blocks: Blocks,
    /// Stops, for what follows.
    pub exposure: f32,
    /// Decibels; `None` for equal pictures.
    pub psnr: Option<f64>,
    /// FLIP of every pixel; empty where it is not built in.
    pub flip: Vec<f32>,
}

impl Comparison {
    /// Mean FLIP over the compared pixels.
    pub fn mean_flip(&self) -> Option<f64> {
        let pixels = self.a.pixels.iter().zip(&self.b.pixels);
        let good = self.flip.iter().zip(pixels).filter(|(_, (a, b))| comparable(**a, **b));
        let sum: f64 = good.map(|(error, _)| f64::from(*error)).sum();
        (!self.flip.is_empty()).then(|| sum / self.difference.pixels as f64)
    }

    /// z of the block that a pixel is in; 0 where it has none.
    pub fn z_at(&self, pixel: usize) -> f64 {
        let width = self.size.x as usize;
        let block = self.blocks.block_of(UVec2::new((pixel % width) as u32, (pixel / width) as u32));
        block.worst().map_or(0.0, |(z, _)| z)
    }
}
