//! What is compared of a ray, in the order in which one thing follows from another.

use glam::{DVec2, DVec3};

use crate::cpu::turn::{RayKind, Turn};

/// Up to four numbers that belong together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Values {
    numbers: [f64; 4],
    count: usize,
}

/// How a difference is measured, and so what of it a rounding explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// By the distances that there are: how far the ray's origin is from the scene's, and its end from there.
    Length,
    /// As it is: of unit vectors.
    Absolute,
    /// As it is: of the weights of a triangle's corners.
    Weights,
    /// By the largest of the numbers.
    Relative,
    /// Random numbers are the same to the bit.
    Exact,
}

/// Something that is decided, by name: what each decision is a number for.
pub struct Choice {
    pub name: &'static str,
    pub of: fn(&Turn) -> Option<u64>,
}

pub struct Quantity {
    pub name: &'static str,
    pub measure: Measure,
    pub of: fn(&Turn) -> Option<Values>,
}

pub enum Step {
    Choice(Choice),
    Quantity(Quantity),
}

impl Values {
    pub fn numbers(&self) -> &[f64] {
        &self.numbers[..self.count]
    }

    pub fn largest(&self) -> f64 {
        self.numbers().iter().fold(0.0, |most, number| most.max(number.abs()))
    }

    /// The largest difference of two numbers; NaN if one is none.
    pub fn distance(&self, other: &Values) -> f64 {
        let differences =
            self.numbers().iter().zip(other.numbers()).map(|(a, b)| if a == b { 0.0 } else { (a - b).abs() });
        differences.fold(
            0.0,
            |most: f64, difference| if difference.is_nan() || most.is_nan() { f64::NAN } else { most.max(difference) },
        )
    }
}

impl From<f64> for Values {
    fn from(number: f64) -> Self {
        Self { numbers: [number, 0.0, 0.0, 0.0], count: 1 }
    }
}

impl From<DVec2> for Values {
    fn from(v: DVec2) -> Self {
        Self { numbers: [v.x, v.y, 0.0, 0.0], count: 2 }
    }
}

impl From<DVec3> for Values {
    fn from(v: DVec3) -> Self {
        Self { numbers: [v.x, v.y, v.z, 0.0], count: 3 }
    }
}

const fn number(name: &'static str, measure: Measure, of: fn(&Turn) -> Option<Values>) -> Step {
    Step::Quantity(Quantity { name, measure, of })
}

const fn choice(name: &'static str, of: fn(&Turn) -> Option<u64>) -> Step {
    Step::Choice(Choice { name, of })
}

/// Of a segment alone: a shadow ray only tells whether its light is seen.
fn segment(turn: &Turn) -> Option<&Turn> {
    (turn.kind == RayKind::Segment).then_some(turn)
}

/// Whether a ray's light changes the pixel by more than a rounding. Where a path lends, what it keeps is the difference of two numbers,
/// and of two that are nearly one only rounding is left.
fn is_felt(turn: &Turn) -> bool {
    let beside = match turn.kind {
        RayKind::Segment => turn.lent.max_element(),
        RayKind::Shadow => turn.radiance.max_element().max(LEAST_RADIANCE),
    };
    turn.throughput.max_element() > UNFELT * beside
}

/// A number of the pixel's, or 0 if the ray's light is not felt.
fn felt(turn: &Turn, number: DVec3) -> DVec3 {
    if is_felt(turn) { number } else { DVec3::ZERO }
}

/// Some roundings, as part of what they are roundings of.
const UNFELT: f64 = 1.0 / 1_048_576.0;

/// Radiance that nobody sees.
const LEAST_RADIANCE: f64 = 1e-3;

use Measure::{Absolute, Exact, Length, Relative, Weights};

/// All of it.
pub static STEPS: &[Step] = &[
    choice("kind of ray", |turn| Some(u64::from(turn.kind == RayKind::Shadow))),
    number("origin", Length, |turn| Some(turn.origin.into())),
    number("direction", Absolute, |turn| Some(turn.direction.into())),
    number("throughput", Relative, |turn| Some(felt(turn, turn.throughput).into())),
    number("lent throughput", Relative, |turn| segment(turn).map(|turn| turn.lent.into())),
    number("pdf", Relative, |turn| segment(turn).map(|turn| turn.pdf.into())),
    choice("triangle", |turn| segment(turn)?.met.map(|met| met.triangle.into())),
    choice("light is seen", |turn| {
        (turn.kind == RayKind::Shadow && is_felt(turn)).then_some(u64::from(turn.is_seen()))
    }),
    number("t", Length, |turn| segment(turn)?.met.map(|met| met.t.into())),
    number("weights", Weights, |turn| segment(turn)?.met.map(|met| met.b.into())),
    number("emitted", Relative, |turn| segment(turn).map(|turn| turn.emitted.into())),
    number("pdf of light sampling", Relative, |turn| segment(turn).map(|turn| turn.found_pdf.into())),
    number("added", Relative, |turn| Some(felt(turn, turn.added).into())),
    choice("is shaded", |turn| Some(u64::from(turn.surface.is_some()))),
    choice("back face", |turn| turn.surface.map(|surface| surface.back_face.into())),
    number("position", Length, |turn| turn.surface.map(|surface| surface.position.into())),
    number("geometric normal", Absolute, |turn| turn.surface.map(|surface| surface.geometric.into())),
    number("shading normal", Absolute, |turn| turn.surface.map(|surface| surface.shading.into())),
    number("u of choices", Exact, |turn| turn.surface.map(|surface| surface.choices.into())),
    choice("a light is sampled", |turn| segment(turn).map(|turn| turn.light.is_some().into())),
    number("u of the light", Exact, |turn| turn.light.map(|light| light.u.into())),
    choice("light's triangle", |turn| turn.light.map(|light| light.triangle.map_or(u64::MAX, u64::from))),
    number("light's direction", Absolute, |turn| turn.light.map(|light| light.direction.into())),
    number("light's f cos", Relative, |turn| turn.light.map(|light| light.value.into())),
    number("light's pdf", Relative, |turn| turn.light.map(|light| light.pdf.into())),
    number("light's radiance", Relative, |turn| turn.light.map(|light| light.radiance.into())),
    number("light's BSDF pdf", Relative, |turn| turn.light.map(|light| light.bsdf_pdf.into())),
    number("light's MIS weight", Relative, |turn| turn.light.map(|light| light.weight.into())),
    choice("a direction is drawn", |turn| segment(turn).map(|turn| turn.drawn.is_some().into())),
    number("u of the direction", Exact, |turn| turn.drawn.map(|drawn| drawn.u.into())),
    choice("lobe of one direction", |turn| turn.drawn.map(|drawn| (drawn.pdf == 0.0).into())),
    number("drawn direction", Absolute, |turn| turn.drawn.map(|drawn| drawn.direction.into())),
    number("drawn pdf", Relative, |turn| turn.drawn.map(|drawn| drawn.pdf.into())),
    number("drawn weight", Relative, |turn| turn.drawn.map(|drawn| drawn.weight.into())),
    number("survival", Relative, |turn| turn.drawn.map(|drawn| drawn.survival.into())),
    choice("goes on", |turn| turn.drawn.map(|drawn| drawn.goes_on.into())),
    number("radiance", Relative, |turn| Some(turn.radiance.into())),
];

/// All numbers that are known of a ray, by name.
pub fn numbers_of(turn: &Turn) -> impl Iterator<Item = (&'static str, Values)> {
    STEPS.iter().filter_map(|step| match step {
        Step::Quantity(quantity) => Some((quantity.name, (quantity.of)(turn)?)),
        Step::Choice(_) => None,
    })
}
