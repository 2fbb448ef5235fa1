//! What is wrong with a surface's code, from its own answers: does it draw as its pdf says, and say the same twice?
//!
//! A false alarm is worse than a missed one. Thresholds are some six standard errors beyond what roundings do to the sharpest
//! lobes; where a lobe is too sharp for the points, nothing is said. Directions are of world space, unit length.

mod cells;

use std::fmt;

use glam::{DVec3, Vec3};

use crate::layout::lint::{LintAnswer, LintCase};
use crate::layout::trace::{MATERIAL_DIELECTRIC, MaterialRecord};
pub use cells::{Cells, POINTS};

/// Draws of a surface; as many as there are points, so that one pass does for both.
pub const DRAWS: usize = POINTS;

/// The first of them only say where the cells are to be.
const TRIAL: usize = 2048;

/// From fewer of these no cells are made.
const FEWEST: usize = 256;

/// Part by which two numbers that should be one may differ: a sharp lobe's pdf at a grazing angle errs by as much.
const ROUNDING: f64 = 0.03;

/// Draws, of a hundred, that may differ by more.
const STRAY: f64 = 0.01;

/// Part of an integral by which roundings may move it.
const MARGIN: f64 = 0.02;

/// Standard errors beyond that.
const ERRORS: f64 = 6.0;

/// Standard error of the integral above which a lobe is too sharp to be judged.
const MOST_NOISE: f64 = 0.01;

/// Something wrong with a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flaw {
    /// Numbers that are none, below 0 or infinite, or directions that are not of unit length: so many draws.
    Broken { draws: usize },
    /// The integral of the pdf and the probability of what has none, together.
    Integral { total: f64 },
    /// Where draws fall, against where the pdf says, in the worst cell; and how many deviations that is.
    Misdrawn { drawn: f64, promised: f64, deviations: f64 },
    /// A sample's pdf, and that of evaluating its direction.
    OtherPdf { sampled: f64, evaluated: f64 },
    /// A sample's weight, and f cos / pdf in its direction.
    OtherWeight { weight: f64, quotient: f64 },
    /// The largest channel of the mean weight, and what it may be.
    Gain { mean: f64, most: f64 },
    /// What paths lend to other pixels is other, by this part at most, where it is seen from elsewhere.
    Viewed { change: f64 },
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Flaw::Broken { draws } => write!(
                f,
                "{draws} of {DRAWS} samples have numbers that are NaN, infinite or negative, or no direction of unit length"
            ),
            Flaw::Integral { total } => {
                write!(f, "mixture_evaluate's pdf and what has none come to {total:.3} over all directions, not to 1")
            }
            Flaw::Misdrawn { drawn, promised, deviations } => write!(
                f,
                "mixture_sample draws {:.2} % of its directions where the pdf promises {:.2} % (chi-square is {deviations:.0} deviations out)",
                100.0 * drawn,
                100.0 * promised
            ),
            Flaw::OtherPdf { sampled, evaluated } => {
                write!(f, "mixture_sample says a pdf of {sampled:.4} where mixture_evaluate says {evaluated:.4}")
            }
            Flaw::OtherWeight { weight, quotient } => {
                write!(f, "mixture_sample gives a weight of {weight:.4} where value / pdf is {quotient:.4}")
            }
            Flaw::Gain { mean, most } => {
                write!(f, "light is gained: the mean weight is {mean:.3}, and may be {most:.3}")
            }
            Flaw::Viewed { change } => write!(
                f,
                "what is lent to other pixels changes by up to {:.0} % with the view, so pictures with `reuse: Tiles` are biased: \
                 leave that out of mixture_seen_from_anywhere, or trace with `--reuse off`",
                100.0 * change
            ),
        }
    }
}

/// The draws of a surface, and the points at which its pdf is evaluated.
pub struct Trial<'a> {
    case: &'a LintCase,
    draws: &'a [LintAnswer],
    cells: Option<Cells>,
}

impl<'a> Trial<'a> {
    /// `draws`: [`DRAWS`] of the surface. Returns [`POINTS`] directions too, at which its pdf is to be evaluated.
    pub fn new(case: &'a LintCase, draws: &'a [LintAnswer], seed: u32) -> (Self, Vec<DVec3>) {
        let (normal, wo) = (case.normal.as_dvec3(), case.wo.as_dvec3());
        let mirror = (normal * (2.0 * normal.dot(wo)) - wo).normalize_or(normal);
        let first = &draws[..TRIAL.min(draws.len())];
        let spread: Vec<DVec3> =
            first.iter().filter(|d| has_density(d)).map(|d| d.direction.as_dvec3().normalize_or(normal)).collect();
        let (cells, points) = Cells::of(&spread, mirror, seed);
        (Self { case, draws, cells: (spread.len() >= FEWEST).then_some(cells) }, points)
    }

    /// What is wrong, the gravest first: what follows from broken numbers alone is left out. `answers`: at the points.
    pub fn judge(&self, answers: &[LintAnswer]) -> Vec<Flaw> {
        let draws = self.draws.iter().filter(|draw| is_broken(draw, true)).count();
        let evaluated = answers.iter().filter(|answer| is_broken(answer, false)).count();
        if draws + evaluated > 0 {
            return vec![Flaw::Broken { draws: draws.max(evaluated) }];
        }
        let mut flaws: Vec<Flaw> = self.two_words().into_iter().collect();
        if let Some(cells) = &self.cells {
            let pdf: Vec<f64> = answers.iter().map(|answer| f64::from(answer.evaluated)).collect();
            flaws.extend(self.distribution(cells, &pdf));
        }
        flaws.extend(self.furnace());
        flaws.extend(self.views());
        flaws
    }

    /// Whether the two functions say the same of one direction.
    fn two_words(&self) -> Option<Flaw> {
        let with: Vec<&LintAnswer> = self.draws.iter().filter(|draw| has_density(draw)).collect();
        let many = |found: usize| found as f64 > STRAY * with.len() as f64;
        let differ = |a: f64, b: f64| (a - b).abs() > ROUNDING * a.abs().max(b.abs()).max(1e-12);
        let pdfs = |d: &LintAnswer| (f64::from(d.pdf), f64::from(d.evaluated));
        let other: Vec<(f64, f64)> = with.iter().map(|d| pdfs(d)).filter(|(a, b)| differ(*a, *b)).collect();
        if many(other.len()) {
            return other.first().map(|&(sampled, evaluated)| Flaw::OtherPdf { sampled, evaluated });
        }
        let weights = |d: &LintAnswer| {
            let channel = |v: Vec3| f64::from(v.max_element());
            (channel(d.weight), channel(d.value) / f64::from(d.pdf))
        };
        let other: Vec<(f64, f64)> =
            with.iter().map(|d| weights(d)).filter(|(a, b)| differ(*a, *b) && a.max(*b) > 1e-4).collect();
        other.first().filter(|_| many(other.len())).map(|&(weight, quotient)| Flaw::OtherWeight { weight, quotient })
    }

    /// The pdf's integral, or where that is right, chi-square of the draws that the cells were not made from.
    fn distribution(&self, cells: &Cells, pdf: &[f64]) -> Option<Flaw> {
        let parts = cells.integrate(pdf);
        let rest = self.draws.iter().skip(TRIAL);
        let count = rest.len() as f64;
        let without = rest.clone().filter(|draw| !has_density(draw)).count() as f64 / count;
        let noise = parts.iter().map(|part| part.variance).sum::<f64>().sqrt();
        if noise > MOST_NOISE {
            return None;
        }
        let total = parts.iter().map(|part| part.integral).sum::<f64>() + without;
        let error = noise + (without * (1.0 - without) / count).sqrt();
        if (total - 1.0).abs() > MARGIN + ERRORS * error {
            return Some(Flaw::Integral { total });
        }
        let directions = rest.filter(|d| has_density(d)).map(|d| d.direction.as_dvec3().normalize_or(DVec3::Z));
        let observed = cells.count(directions);
        let (mut statistic, mut worst, mut drawn, mut promised) = (0.0, 0.0, 0.0, 0.0);
        for (seen, part) in observed.iter().zip(&parts) {
            let (seen, expected) = (*seen as f64, count * part.integral);
            // The integral's own error, and what roundings do to it.
            let unsure = count * count * part.variance + (0.01 * expected).powi(2);
            let term = (seen - expected).powi(2) / (expected.max(5.0) + unsure);
            statistic += term;
            if term > worst {
                (worst, drawn, promised) = (term, seen / count, part.integral);
            }
        }
        // Wilson and Hilferty 1931.
        let degrees = observed.len() as f64;
        let spread = 2.0 / (9.0 * degrees);
        let deviations = ((statistic / degrees).cbrt() - (1.0 - spread)) / spread.sqrt();
        (deviations > ERRORS).then_some(Flaw::Misdrawn { drawn, promised, deviations })
    }

    /// Whether more comes back than a white surroundings sends.
    fn furnace(&self) -> Option<Flaw> {
        let most = self.largest_albedo();
        let count = self.draws.len() as f64;
        let sum: DVec3 = self.draws.iter().map(|draw| draw.weight.as_dvec3()).sum();
        let mean = sum / count;
        let squares: DVec3 = self.draws.iter().map(|draw| (draw.weight.as_dvec3() - mean).powf(2.0)).sum();
        let error = (squares / (count * count)).max_element().sqrt();
        let mean = mean.max_element();
        (mean > most + 0.01 + ERRORS * error).then_some(Flaw::Gain { mean, most })
    }

    /// Whether what is lent looks the same from everywhere.
    fn views(&self) -> Option<Flaw> {
        let changes: Vec<f64> = self.draws.iter().map(|draw| f64::from(draw.change_with_view)).collect();
        let other = changes.iter().filter(|change| **change > ROUNDING).count() as f64;
        let change = changes.iter().copied().fold(0.0, f64::max);
        (other > STRAY * changes.len() as f64).then_some(Flaw::Viewed { change })
    }

    /// 1, unless the material as it was written reflects more, or squeezes radiance.
    fn largest_albedo(&self) -> f64 {
        let material: &MaterialRecord = &self.case.material;
        let eta_squared = if material.flags & MATERIAL_DIELECTRIC != 0 { f64::from(material.ni).powi(2) } else { 1.0 };
        f64::from((material.kd + material.ks).max_element()).max(eta_squared)
    }
}

fn has_density(draw: &LintAnswer) -> bool {
    draw.pdf > 0.0
}

fn is_broken(answer: &LintAnswer, drawn: bool) -> bool {
    let fine = |v: f32| v.is_finite() && v >= 0.0;
    let all = |v: Vec3| v.to_array().into_iter().all(fine);
    let unit = answer.direction.is_finite() && (answer.direction.length() - 1.0).abs() < 1e-3;
    !(fine(answer.pdf) && fine(answer.evaluated) && all(answer.weight) && all(answer.value)) || drawn && !unit
}
