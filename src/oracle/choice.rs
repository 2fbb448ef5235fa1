//! Choices by weight, and what weighs.

use glam::DVec3;

/// A choice among numbered things by weight.
#[derive(Default)]
pub struct Distribution {
    /// Running sums of the weights; empty where all are 0.
    sums: Vec<f64>,
}

impl Distribution {
    pub fn new(weights: impl Iterator<Item = f64>) -> Self {
        let running = |sum: &mut f64, weight: f64| {
            *sum += weight;
            Some(*sum)
        };
        let sums: Vec<f64> = weights.scan(0.0, running).collect();
        Self { sums: if sums.last().is_some_and(|sum| *sum > 0.0) { sums } else { Vec::new() } }
    }

    pub fn is_empty(&self) -> bool {
        self.sums.is_empty()
    }

    /// Probability of a thing.
    pub fn chance(&self, index: usize) -> f64 {
        let Some(total) = self.sums.last() else { return 0.0 };
        let before = if index > 0 { self.sums[index - 1] } else { 0.0 };
        (self.sums[index] - before) / total
    }

    /// The thing at `u` in [0, 1); never one of weight 0. There are some.
    pub fn draw(&self, u: f64) -> usize {
        let total = self.sums[self.sums.len() - 1];
        let last = self.sums.partition_point(|sum| *sum < total);
        self.sums.partition_point(|sum| *sum <= u * total).min(last)
    }
}

/// Rec.709.
pub fn luminance(rgb: DVec3) -> f64 {
    rgb.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}
