//! The environment's picture to pixels, and to the tables that directions are drawn from.

use glam::{UVec2, Vec3, Vec4};

use super::cdf::cdf_table;
use crate::layout::cdf::CdfEntry;
use crate::layout::sky::SkyTable;
use crate::layout::trace::luminance;

impl SkyTable {
    /// From the pixels of the whole sphere by longitude and latitude, times a factor a channel; `pixels` has `size.x * size.y` of them.
    pub fn new(size: UVec2, pixels: &[Vec3], factor: Vec3) -> Self {
        let cells: Vec<Vec4> = pixels.iter().map(|pixel| (*pixel * factor).extend(0.0)).collect();
        let mut cdf = Vec::with_capacity((size.y + size.x * size.y) as usize);
        let (mut rows, mut within) = (Vec::new(), Vec::new());
        for (y, row) in cells.chunks_exact(size.x as usize).enumerate() {
            let weights: Vec<f64> = row.iter().map(|cell| f64::from(luminance(cell.truncate()))).collect();
            rows.push(weights.iter().sum::<f64>() * cell_angle(size, y));
            // A dark row is never drawn.
            match cdf_table(&weights) {
                table if table.is_empty() => within.extend(row.iter().map(|_| CdfEntry::default())),
                table => within.extend(table),
            }
        }
        cdf.extend(cdf_table(&rows));
        cdf.extend(within);
        let brightest = cells.iter().map(|cell| cell.max_element()).fold(0.0, f32::max);
        let power = Some(rows.iter().sum::<f64>()).filter(|power| ((1.0 / power) as f32).is_finite());
        Self { size, cells, cdf, power: power.unwrap_or(0.0), brightest }
    }
}

/// Solid angle of a pixel of row `y`.
fn cell_angle(size: UVec2, y: usize) -> f64 {
    let angle = |row: usize| std::f64::consts::PI * row as f64 / f64::from(size.y);
    // cos(a) - cos(b), without loss at the poles.
    let (a, b) = (angle(y), angle(y + 1));
    2.0 * ((a + b) * 0.5).sin() * ((b - a) * 0.5).sin() * std::f64::consts::TAU / f64::from(size.x)
}
