//! Cells of the sphere that as many draws fall into, however sharp their lobe is.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::cpu::rng::{sample_2d, sample_key};

/// The sphere cut twofold so many times.
const CUTS: u32 = 6;

/// A cell's points lie in strata of so many a side, two in each: their difference tells the error.
const SIDE: usize = 8;

/// Points of all cells together.
pub const POINTS: usize = (1 << CUTS) * SIDE * SIDE * 2;

/// Draws that come nearer to the axis than what the chart resolves.
const NEAREST: usize = 8;

/// A part of the chart.
#[derive(Clone, Copy)]
struct Cell {
    low: DVec2,
    high: DVec2,
}

/// A map of the sphere to the unit square: x grows with the logarithm of 1 - cos of the angle from an axis, y is the turn about it.
struct Chart {
    axis: DVec3,
    t: DVec3,
    b: DVec3,
    /// Where the logarithm begins.
    soft: f64,
    /// The logarithm's range.
    range: f64,
}

impl Chart {
    fn place(&self, direction: DVec3) -> DVec2 {
        let below = 0.5 * direction.distance_squared(self.axis);
        let turn = (direction.dot(self.b).atan2(direction.dot(self.t)) / TAU).rem_euclid(1.0);
        DVec2::new((below / self.soft).ln_1p() / self.range, turn).clamp(DVec2::ZERO, DVec2::ONE)
    }

    /// A direction, and the solid angle by area of the chart.
    fn direction(&self, at: DVec2) -> (DVec3, f64) {
        let below = (self.soft * (at.x * self.range).exp_m1()).min(2.0);
        let turn = DVec2::from_angle(TAU * at.y) * (below * (2.0 - below)).max(0.0).sqrt();
        (self.axis * (1.0 - below) + self.t * turn.x + self.b * turn.y, TAU * self.range * (self.soft + below))
    }
}

/// Cells with the points in them where a pdf is evaluated.
pub struct Cells {
    chart: Chart,
    cells: Vec<Cell>,
    /// Solid angle by area of the chart at each point.
    stretch: Vec<f64>,
}

/// What a cell's points say of the integral of the pdf over it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Part {
    pub integral: f64,
    pub variance: f64,
}

impl Cells {
    /// Cells that as many of `draws` fall into, unit directions about an axis. Returns the points too, cell by cell.
    pub fn of(draws: &[DVec3], axis: DVec3, seed: u32) -> (Cells, Vec<DVec3>) {
        let mut below: Vec<f64> = draws.iter().map(|d| 0.5 * d.distance_squared(axis)).collect();
        below.sort_by(f64::total_cmp);
        let soft = below.get(NEAREST.min(below.len().saturating_sub(1))).copied().unwrap_or(1.0).clamp(1e-12, 1.0);
        let (t, b) = axis.any_orthonormal_pair();
        let chart = Chart { axis, t, b, soft, range: (2.0 / soft).ln_1p() };
        let mut places: Vec<DVec2> = draws.iter().map(|d| chart.place(*d)).collect();
        let mut cells = Vec::new();
        cut(&mut places, Cell { low: DVec2::ZERO, high: DVec2::ONE }, 0, &mut cells);
        let (mut points, mut stretch) = (Vec::with_capacity(POINTS), Vec::with_capacity(POINTS));
        for cell in &cells {
            for stratum in 0..SIDE * SIDE * 2 {
                let corner = DVec2::new((stratum / 2 % SIDE) as f64, (stratum / 2 / SIDE) as f64);
                let jitter = sample_2d(sample_key(points.len() as u32, 0, seed), 0);
                let at = cell.low + (cell.high - cell.low) * (corner + jitter) / SIDE as f64;
                let (direction, by_area) = chart.direction(at);
                points.push(direction);
                stretch.push(by_area);
            }
        }
        (Cells { chart, cells, stretch }, points)
    }

    /// The pdf's integral over each cell, from what it is at the points.
    pub fn integrate(&self, pdf: &[f64]) -> Vec<Part> {
        let values: Vec<f64> = pdf.iter().zip(&self.stretch).map(|(pdf, by_area)| pdf * by_area).collect();
        let strata = (SIDE * SIDE) as f64;
        let part = |(cell, values): (&Cell, &[f64])| {
            let area = (cell.high - cell.low).element_product();
            let mean = values.iter().sum::<f64>() / (2.0 * strata);
            let spread: f64 = values.chunks_exact(2).map(|pair| 0.25 * (pair[0] - pair[1]).powi(2)).sum();
            Part { integral: area * mean, variance: (area / strata).powi(2) * spread }
        };
        self.cells.iter().zip(values.chunks_exact(SIDE * SIDE * 2)).map(part).collect()
    }

    /// How many of some directions fall into each cell.
    pub fn count(&self, draws: impl Iterator<Item = DVec3>) -> Vec<u64> {
        let mut counts = vec![0; self.cells.len()];
        for place in draws.map(|d| self.chart.place(d)) {
            let inside = |cell: &Cell| place.cmpge(cell.low).all() && place.cmple(cell.high).all();
            if let Some(found) = self.cells.iter().position(inside) {
                counts[found] += 1;
            }
        }
        counts
    }
}

/// Halves a cell at the median of what is in it, along x and y by turns.
fn cut(places: &mut [DVec2], cell: Cell, depth: u32, cells: &mut Vec<Cell>) {
    if depth == CUTS {
        cells.push(cell);
        return;
    }
    let axis = (depth % 2) as usize;
    places.sort_by(|a, b| a[axis].total_cmp(&b[axis]));
    let (low, high) = (cell.low[axis], cell.high[axis]);
    let median = places.get(places.len() / 2).map_or(0.5 * (low + high), |place| place[axis]);
    // Where all draws lie in one place, cells still have an inside.
    let border = median.clamp(low + 0.01 * (high - low), high - 0.01 * (high - low));
    let split = places.partition_point(|place| place[axis] < border);
    let (mut below, mut above) = (cell, cell);
    below.high[axis] = border;
    above.low[axis] = border;
    let (left, right) = places.split_at_mut(split);
    cut(left, below, depth + 1, cells);
    cut(right, above, depth + 1, cells);
}
