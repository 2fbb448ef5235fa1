//! The sun's disk: sunlight as it is above the air, weakened by the air on its way, as a colour.
//!
//! Above the air it is a black body of 5,778 K. The air is that of Preetham, Shirley and Smits, "A Practical Analytic Model for Daylight"
//! (1999), without what acts on the far red alone (mixed gases, water). The disk is even: its edge is not dimmed.

use std::f64::consts::PI;

use glam::DVec3;

use crate::components::Daylight;
use crate::layout::sky::Sun;

/// A radiance of 1, W m^-2 sr^-1 as the eye weights it (the weight is 1 at 555 nm): 683 lm/W make it 34,150 cd/m^2. So white ground at noon,
/// the sun at 60 degrees and turbidity 3, is just below 1.
pub const UNIT: f64 = 50.0;

/// Absorption of ozone, 1/cm, from 450 nm on in steps of 10 nm; none elsewhere.
const OZONE: [f64; 33] = [
    0.003, 0.006, 0.009, 0.014, 0.021, 0.030, 0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120, 0.120, 0.115, 0.125,
    0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048, 0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009, 0.007,
    0.004,
];

/// Ozone above the ground, cm.
const OZONE_DEPTH: f64 = 0.35;

/// The sun of a day; none where no light of it arrives.
pub fn sun_of(day: &Daylight) -> Option<Sun> {
    let (azimuth, elevation) = (day.azimuth.to_radians(), elevation(day));
    let level = elevation.cos();
    let direction = DVec3::new(level * azimuth.sin(), elevation.sin(), -level * azimuth.cos());
    let size = day.sun_size.clamp(0.01, 90.0);
    // Another size is another radiance, so that it sends the same.
    let spread = solid_angle(Daylight::SUN_SIZE) / solid_angle(size);
    let radiance = (f64::from(day.strength) * spread * sun_radiance(day)).as_vec3();
    let sun = Sun { direction: direction.as_vec3(), radiance, chord_squared: chord_squared(size) as f32 };
    (radiance.max_element() > 0.0 && radiance.is_finite()).then_some(sun)
}

/// Radiance of the sun at its own size and strength 1.
pub fn sun_radiance(day: &Daylight) -> DVec3 {
    const STEP: f64 = 5.0;
    let height = elevation(day);
    // Air on the way against that on the way from the zenith (Kasten 1965).
    let air = 1.0 / (height.sin() + 0.15 * (3.885 + height.to_degrees()).powf(-1.253));
    let haze = (0.046_083_658 * f64::from(day.turbidity) - 0.045_860_259).max(0.0);
    let mut xyz = DVec3::ZERO;
    for i in 0..=80 {
        let nm = 380.0 + STEP * f64::from(i);
        let um = nm / 1000.0;
        let depth = 0.008735 * um.powf(-4.08) + haze * um.powf(-1.3) + OZONE_DEPTH * ozone(nm);
        xyz += STEP * black_body(nm) * (-air * depth).exp() * seen(nm);
    }
    let rgb = DVec3::new(
        xyz.dot(DVec3::new(3.2404542, -1.5371385, -0.4985314)),
        xyz.dot(DVec3::new(-0.9692660, 1.8760108, 0.0415560)),
        xyz.dot(DVec3::new(0.0556434, -0.2040259, 1.0572252)),
    );
    rgb.max(DVec3::ZERO) / UNIT
}

/// Of the sun, radians.
pub fn elevation(day: &Daylight) -> f64 {
    day.elevation.clamp(0.0, 90.0).to_radians()
}

/// Of a disk of so many degrees across.
pub fn solid_angle(size: f64) -> f64 {
    PI * chord_squared(size)
}

/// From the middle of such a disk to its edge, as unit vectors: the distance squared.
fn chord_squared(size: f64) -> f64 {
    (2.0 * (size.to_radians() / 4.0).sin()).powi(2)
}

/// Absorption, 1/cm.
fn ozone(nm: f64) -> f64 {
    let at = (nm - 450.0) / 10.0;
    let column = |i: f64| if i >= 0.0 { OZONE.get(i as usize).copied().unwrap_or(0.0) } else { 0.0 };
    let part = at - at.floor();
    (1.0 - part) * column(at.floor()) + part * column(at.floor() + 1.0)
}

/// Radiance of the sun's surface, W m^-2 sr^-1 nm^-1 (Planck).
fn black_body(nm: f64) -> f64 {
    const KELVIN: f64 = 5778.0;
    // 2 h c^2 and h c / k.
    const FIRST: f64 = 1.191_042_972e-16;
    const SECOND: f64 = 0.014_387_769;
    let metres = nm * 1e-9;
    1e-9 * FIRST / metres.powi(5) / ((SECOND / (metres * KELVIN)).exp() - 1.0)
}

/// X, Y and Z of a wavelength (Wyman, Sloan and Shirley, JCGT 2(2), 2013).
fn seen(nm: f64) -> DVec3 {
    let lobe = |height: f64, middle: f64, below: f64, above: f64| {
        let off = (nm - middle) / if nm < middle { below } else { above };
        height * (-0.5 * off * off).exp()
    };
    DVec3::new(
        lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) - lobe(0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    )
}
