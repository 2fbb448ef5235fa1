//! The kernel's rays beside the twin's, number by number, each with what rounding explains.

use super::quantities::{Measure, Quantity, STEPS, Step, Values};
use crate::cpu::turn::{RayKind, Turn};

/// Half of the distance from 1 to the next f32: what one rounding may change.
pub const ROUNDING: f64 = 1.0 / (1 << 24) as f64;

/// How many times as far as shaken paths stray the kernel's may: theirs are few.
const STRAYING: f64 = 4.0;

/// Roundings of a step of its own, of a number that is measured by itself.
const OF_STEP: f64 = 64.0;

/// The same of lengths, unit vectors and weights.
const OF_UNIT: f64 = 16.0;

/// The rays of both.
#[derive(Clone, Debug, Default)]
pub struct Comparison {
    pub turns: Vec<Compared>,
    /// The first thing in which they differ by more than rounding explains, or decide otherwise.
    pub parting: Option<Parting>,
}

/// A ray of both.
#[derive(Clone, Debug, Default)]
pub struct Compared {
    pub rows: Vec<Row>,
    /// What rounding may have come to by this ray, in roundings: the largest of its rows.
    pub growth: f64,
}

/// Some numbers of both.
#[derive(Clone, Debug)]
pub struct Row {
    pub name: &'static str,
    pub measure: Measure,
    pub gpu: Values,
    pub twin: Values,
    /// As it is measured.
    pub difference: f64,
    /// By rounding.
    pub explained: f64,
}

/// Where two paths part.
#[derive(Clone, Debug)]
pub struct Parting {
    /// The ray.
    pub turn: usize,
    pub name: &'static str,
    /// None where it is a decision.
    pub row: Option<Row>,
}

impl Row {
    /// Whether rounding explains the difference.
    pub fn agrees(&self) -> bool {
        self.difference <= self.explained
    }
}

/// Compares up to the first parting; `shaken` are paths of the twin that are off by rounding. Each counts as long as it decides as the
/// twin does.
pub fn compare(gpu: &[Turn], twin: &[Turn], shaken: &[Vec<Turn>]) -> Comparison {
    let mut comparison = Comparison::default();
    let mut alike: Vec<&Vec<Turn>> = shaken.iter().collect();
    let mut slack = 0.0;
    for (i, (ours, right)) in gpu.iter().zip(twin).enumerate() {
        let before = slack;
        slack = slack_of(right, before);
        let mut compared = Compared::default();
        for step in STEPS {
            let quantity = match step {
                Step::Choice(choice) => {
                    alike.retain(|path| path.get(i).is_some_and(|turn| (choice.of)(turn) == (choice.of)(right)));
                    if (choice.of)(ours) != (choice.of)(right) {
                        comparison.parting = Some(Parting { turn: i, name: choice.name, row: None });
                        comparison.turns.push(compared);
                        return comparison;
                    }
                    continue;
                }
                Step::Quantity(quantity) => quantity,
            };
            let ((Some(a), Some(b)), size) = (((quantity.of)(ours), (quantity.of)(right)), size_of(right)) else {
                continue;
            };
            let strays =
                alike.iter().filter_map(|path| (quantity.of)(path.get(i)?)).map(|c| measured(quantity, &c, &b, size));
            // Where no shaken path decides as the twin any more, all is rounding's.
            let strays = if alike.is_empty() { f64::INFINITY } else { strays.fold(0.0, f64::max) };
            let own = of_step(quantity.measure, right, before / size, size);
            let explained = if quantity.measure == Measure::Exact { 0.0 } else { own + STRAYING * strays };
            let difference = measured(quantity, &a, &b, size);
            let row = Row { name: quantity.name, measure: quantity.measure, gpu: a, twin: b, difference, explained };
            compared.growth = compared.growth.max(explained / ROUNDING);
            compared.rows.push(row.clone());
            if !row.agrees() {
                comparison.parting = Some(Parting { turn: i, name: row.name, row: Some(row) });
                comparison.turns.push(compared);
                return comparison;
            }
        }
        comparison.turns.push(compared);
    }
    if gpu.len() != twin.len() {
        comparison.parting = Some(Parting { turn: gpu.len().min(twin.len()), name: "number of rays", row: None });
    }
    comparison
}

/// By how much rounding moves the point from which the next ray begins.
fn slack_of(turn: &Turn, before: f64) -> f64 {
    if turn.kind == RayKind::Segment { turn.slack.position + turn.slack.offset } else { before }
}

/// The distances that lengths of a ray are measured by.
fn size_of(turn: &Turn) -> f64 {
    let t = turn.met.map_or(0.0, |met| met.t);
    (turn.origin.abs().max_element() + t).max(f64::MIN_POSITIVE)
}

/// A difference as it is measured.
fn measured(quantity: &Quantity, a: &Values, b: &Values, size: f64) -> f64 {
    let distance = a.distance(b);
    match quantity.measure {
        _ if distance == 0.0 => 0.0,
        Measure::Length => distance / size,
        Measure::Absolute | Measure::Weights | Measure::Exact => distance,
        Measure::Relative => distance / a.largest().max(b.largest()),
    }
}

/// What a step rounds by itself, without what comes from those before it; `before` is the slack of the ray's origin.
fn of_step(measure: Measure, turn: &Turn, before: f64, size: f64) -> f64 {
    match measure {
        Measure::Length => OF_UNIT * ROUNDING + 2.0 * (before + turn.slack.position / size),
        Measure::Absolute => OF_UNIT * ROUNDING,
        Measure::Weights => OF_UNIT * ROUNDING + 2.0 * turn.slack.weights,
        Measure::Relative => OF_STEP * ROUNDING * f64::from(turn.bounce + 1),
        Measure::Exact => 0.0,
    }
}
