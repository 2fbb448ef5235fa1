//! Cells of the sphere that follow a lobe.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use lucerna::cpu::bsdf::{Specular, mirror};

use super::{BsdfProbe, frame};
use crate::statistics::{CHI_SQUARE_LIMIT, chi_square_z};

/// Cells about an axis: rows of the angle from it with bounds `rows`, of equal turns.
pub struct Cells {
    pub axis: DVec3,
    pub rows: Vec<f64>,
    pub turns: usize,
}

impl Cells {
    fn frame(&self) -> (DVec3, DVec3) {
        self.axis.any_orthonormal_pair()
    }

    pub fn count(&self, draws: impl Iterator<Item = DVec3>) -> Vec<u64> {
        let (t, b) = self.frame();
        let mut counts = vec![0; (self.rows.len() - 1) * self.turns];
        for d in draws {
            let angle = 2.0 * (0.5 * d.distance(self.axis)).min(1.0).asin();
            let turn = (d.dot(b).atan2(d.dot(t)) / TAU).rem_euclid(1.0);
            let row = self.rows.partition_point(|&bound| bound <= angle).clamp(1, self.rows.len() - 1) - 1;
            counts[row * self.turns + ((turn * self.turns as f64) as usize).min(self.turns - 1)] += 1;
        }
        counts
    }

    /// The integral of a pdf over each cell, by Gauss's rule of 3 points along both, on parts of each cell.
    pub fn integrate(&self, pdf: impl Fn(DVec3) -> f64) -> Vec<f64> {
        const PARTS: usize = 6;
        const NODES: [(f64, f64); 3] =
            [(0.112701665379258, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887298334620742, 5.0 / 18.0)];
        let (t, b) = self.frame();
        let mut integrals = Vec::new();
        for row in self.rows.windows(2) {
            for turn in 0..self.turns {
                let mut sum = 0.0;
                for part in 0..PARTS * PARTS {
                    for node in 0..9 {
                        let ((x, wx), (y, wy)) = (NODES[node / 3], NODES[node % 3]);
                        let along = ((part / PARTS) as f64 + x) / PARTS as f64;
                        let across = ((part % PARTS) as f64 + y) / PARTS as f64;
                        let angle = row[0] + (row[1] - row[0]) * along;
                        let phi = TAU * (turn as f64 + across) / self.turns as f64;
                        let d = self.axis * angle.cos() + (t * phi.cos() + b * phi.sin()) * angle.sin();
                        sum += wx * wy * pdf(d) * angle.sin();
                    }
                }
                let area = (row[1] - row[0]) * TAU / self.turns as f64 / (PARTS * PARTS) as f64;
                integrals.push(sum * area);
            }
        }
        integrals
    }

    /// Holds draws to a pdf's integrals over the cells, and those to a pdf that is wrong by 12 % to either side.
    pub fn hold(&self, observed: &[u64], integrals: &[f64], count: u32, case: &str) {
        let expected: Vec<f64> = integrals.iter().map(|p| p * f64::from(count)).collect();
        let z = chi_square_z(observed, &expected);
        assert!(z < CHI_SQUARE_LIMIT, "{case}: chi-square is {z} deviations out");
        let tilted = |i: usize| if i % self.turns < self.turns / 2 { 1.12 } else { 0.88 };
        let wrong: Vec<f64> = expected.iter().enumerate().map(|(i, e)| e * tilted(i)).collect();
        assert!(chi_square_z(observed, &wrong) > CHI_SQUARE_LIMIT, "{case}: a pdf wrong by 12 % passes");
    }
}

/// Cells about the mirror direction that grow with the angle as the lobe does, to the far pole.
pub fn cells(probe: &BsdfProbe, lobe: Specular) -> Cells {
    let view = frame(probe);
    let rows = 16;
    // Equal parts of a lobe for most rows, then equal ratios of angles.
    let angle = |part: f64| match lobe {
        Specular::Phong(ns) => (1.0 - part).powf(1.0 / (ns + 1.0)).acos(),
        Specular::Ggx(alpha) => 2.0 * (alpha * (part / (1.0 - part)).sqrt()).atan(),
        Specular::Mirror => panic!("a mirror has no cells"),
    };
    let mut bounds: Vec<f64> = (0..rows).map(|i| angle(f64::from(i) / f64::from(rows))).collect();
    let last = bounds[rows as usize - 1];
    bounds.extend((1..=rows).map(|i| last * (PI / last).powf(f64::from(i) / f64::from(rows))));
    // The Phong lobe's own edge is a bound.
    bounds.push(0.5 * PI);
    bounds.sort_by(f64::total_cmp);
    Cells { axis: mirror(view.shading, view.wo), rows: bounds, turns: 12 }
}
