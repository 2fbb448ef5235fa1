//! Sky sampling in f64: the twin of `passes/trace/sky` and `lib/sky`. A table here has power: some pixel of it is not black.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, UVec2};

use super::cdf::draw_index;
use crate::layout::cdf::CdfEntry;
use crate::layout::sky::SkyTable;
use crate::layout::trace::luminance;

/// A direction of the sky, drawn by radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkySample {
    /// Unit length.
    pub direction: DVec3,
    /// Column and row of the pixel it was drawn in.
    pub cell: UVec2,
    /// By solid angle.
    pub pdf: f64,
    pub radiance: DVec3,
}

/// Column and row of the pixel in a unit direction.
pub fn sky_cell(direction: DVec3, size: UVec2) -> UVec2 {
    let across = 0.5 + direction.x.atan2(-direction.z) / TAU;
    let down = direction.x.hypot(direction.z).atan2(direction.y) / PI;
    (DVec2::new(across, down) * size.as_dvec2()).as_uvec2().min(size - 1)
}

/// A direction within a pixel, uniform by solid angle. Unit length.
pub fn sky_direction(cell: UVec2, size: UVec2, u: DVec2) -> DVec3 {
    let (sin_turn, cos_turn) = (TAU * (f64::from(cell.x) + u.x) / f64::from(size.x)).sin_cos();
    let half_sine = |row: u32| (0.5 * PI * f64::from(row) / f64::from(size.y)).sin();
    let (upper, lower) = (half_sine(cell.y), half_sine(cell.y + 1));
    // 1 - cos is uniform over the row: twice the square of the sine of half the angle.
    let half_squared = upper * upper + u.y * (lower * lower - upper * upper);
    let sin = 2.0 * (half_squared * (1.0 - half_squared)).sqrt();
    DVec3::new(-sin_turn * sin, 1.0 - 2.0 * half_squared, cos_turn * sin)
}

/// Radiance that arrives from a unit direction, and the density by solid angle with which it is drawn.
pub fn sky_arriving(sky: &SkyTable, direction: DVec3) -> (DVec3, f64) {
    at_cell(sky, sky_cell(direction, sky.size))
}

/// A direction by two numbers in [0, 1): a row, then a pixel of the row, then a place in the pixel.
pub fn draw_sky(sky: &SkyTable, u: DVec2) -> SkySample {
    let (rows, pixels) = sky.cdf.split_at(sky.size.y as usize);
    let (row, down) = draw_entry(rows, u.y);
    let first = (row * sky.size.x) as usize;
    let (column, across) = draw_entry(&pixels[first..first + sky.size.x as usize], u.x);
    let cell = UVec2::new(column, row);
    let (radiance, pdf) = at_cell(sky, cell);
    SkySample { direction: sky_direction(cell, sky.size, DVec2::new(across, down)), cell, pdf, radiance }
}

fn at_cell(sky: &SkyTable, cell: UVec2) -> (DVec3, f64) {
    let radiance = sky.cells[(cell.y * sky.size.x + cell.x) as usize].truncate();
    (radiance.as_dvec3(), f64::from(luminance(radiance)) / sky.power)
}

/// An index drawn from a table, and what is left of the uniform number.
fn draw_entry(table: &[CdfEntry], u: f64) -> (u32, f64) {
    let (index, rest) = draw_index(table.len(), u, |index| (table[index].end, table[index].first));
    (index as u32, rest)
}
