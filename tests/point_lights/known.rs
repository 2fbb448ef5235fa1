//! What a floor gets of a light, in closed form.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};
use lucerna::components::{PointLight, SpotCone};
use lucerna::cpu::point::point_intensity;
use lucerna::layout::trace::luminance;
use lucerna::prepare::point::point_light;

use super::{bulb, spot};
use crate::light::{ALBEDO, SEEN, seen_of};
use crate::rooms::{Room, matte};

/// A floor, and a light over it.
pub fn floor(light: &PointLight) -> Room {
    let mut room = Room { next_event: true, ..Room::default() };
    let floor = room.material(matte(Vec3::splat(ALBEDO), Vec3::ZERO));
    room.quad(Vec3::new(-1.0, 0.0, 1.0), 2.0 * Vec3::X, -2.0 * Vec3::Z, floor);
    room.points.push(point_light(light, DVec3::ZERO));
    room
}

/// What leaves the point that is seen: E = I cos / d^2, reflected by a Lambert surface. The light is where single precision has it.
pub fn reflected(light: &PointLight) -> f64 {
    let to = light.position.as_vec3().as_dvec3() - SEEN;
    f64::from(ALBEDO) / PI * f64::from(light.intensity.x) * to.y / to.length().powi(3)
}

#[test]
fn a_point_gives_its_irradiance() {
    let cases = [
        DVec3::new(0.3, 0.8, 0.1),
        // A millimetre above the floor, and 1,000 km.
        SEEN + DVec3::new(0.0, 1e-3, 0.0),
        SEEN + DVec3::new(3e5, 8e5, 5e5),
        // At half a degree.
        SEEN + DVec3::new(0.6, 0.006, 0.4),
    ];
    for position in cases {
        let light = bulb(position, Vec3::splat(3.0));
        let (mean, error) = seen_of(&floor(&light), 1, 2);
        let right = reflected(&light);
        // The camera's pixels cover 1e-6 of the floor: of that, and of single precision, there is a thousandth.
        assert!(error < 1e-3 * right, "{position}: the standard error {error:e} proves nothing of {right:e}");
        assert!((mean / right - 1.0).abs() < 1e-3, "{position}: {mean:e} seen, {right:e} right");
    }
    let below = bulb(SEEN - DVec3::Y, Vec3::ONE);
    assert_eq!(seen_of(&floor(&below), 1, 2).0, 0.0, "the floor hides what is below");
}

#[test]
fn a_spot_fades_by_the_cubic_of_the_cosine() {
    let position = SEEN + DVec3::new(0.0, 2.0, 0.0);
    // The axis misses the point by 20 degrees, of a cone of 50 degrees, whose inner one has 12.5 or 40.
    for (blend, inner) in [(0.75, 6.25f64), (0.2, 20.0), (0.5, 12.5), (0.0, 25.0)] {
        let light = spot(position, SEEN + DVec3::new(2.0 * 20f64.to_radians().tan(), 0.0, 0.0), 50.0, blend);
        let cos = |degrees: f64| degrees.to_radians().cos();
        let t = if inner >= 20.0 { 1.0 } else { (cos(20.0) - cos(25.0)) / (cos(inner) - cos(25.0)) };
        let right = reflected(&light) * t * t * (3.0 - 2.0 * t);
        let (mean, _) = seen_of(&floor(&light), 1, 2);
        assert!((mean / right - 1.0).abs() < 1e-3, "blend {blend}: {mean:e} seen, {right:e} right");
    }
    // Where the edge just leaves it out, and just has it in.
    let aim = SEEN + DVec3::new(2.0 * 20f64.to_radians().tan(), 0.0, 0.0);
    assert_eq!(seen_of(&floor(&spot(position, aim, 39.98, 0.0)), 1, 2).0, 0.0);
    let light = spot(position, aim, 40.02, 0.0);
    assert!((seen_of(&floor(&light), 1, 2).0 / reflected(&light) - 1.0).abs() < 1e-3);
}

#[test]
fn the_power_is_what_is_sent_out() {
    let aim = DVec3::new(1.0, -2.0, 0.5);
    for light in [
        bulb(DVec3::ZERO, Vec3::new(1.0, 2.0, 3.0)),
        spot(DVec3::ZERO, aim, 180.0, 1.0),
        spot(DVec3::ZERO, aim, 60.0, 0.5),
        spot(DVec3::ZERO, aim, 10.0, 0.0),
        spot(DVec3::ZERO, aim, 0.1, 0.3),
    ] {
        let record = point_light(&light, DVec3::ZERO);
        let (axis, edge) = match light.cone {
            Some(SpotCone { angle, .. }) => (aim.normalize(), 0.5 * angle.to_radians()),
            None => (DVec3::Y, PI),
        };
        let side = axis.any_orthonormal_vector();
        let steps = 20_000;
        let sum: f64 = (0..steps)
            .map(|i| {
                let angle = edge * (f64::from(i) + 0.5) / f64::from(steps);
                let direction = angle.cos() * axis + angle.sin() * side;
                let sent = f64::from(luminance(point_intensity(&record, direction).as_vec3()));
                TAU * angle.sin() * sent * edge / f64::from(steps)
            })
            .sum();
        let right = PI * f64::from(record.power);
        assert!((sum / right - 1.0).abs() < 1e-3, "{light:?}: {sum} sent, {right} said");
    }
}

#[test]
fn what_can_be_nowhere_leaves_a_picture() {
    let here = |position: DVec3| bulb(position, Vec3::ONE);
    let nan = f64::NAN;
    let cases = [
        // At the very point that is seen, in the floor's plane, and at an edge of it.
        here(SEEN),
        here(DVec3::new(0.5, 0.0, 0.5)),
        here(DVec3::new(1.0, 0.0, 1.0)),
        here(DVec3::new(nan, 1.0, 0.0)),
        here(DVec3::new(f64::INFINITY, 1.0, 0.0)),
        here(DVec3::splat(1e12)),
        here(SEEN + DVec3::Y * 1e-4),
        PointLight { intensity: Vec3::new(f32::NAN, -1.0, f32::INFINITY), ..here(DVec3::Y) },
        PointLight { intensity: Vec3::splat(1e-40), ..here(DVec3::Y) },
        spot(DVec3::Y, DVec3::Y, 30.0, 0.5),
        spot(DVec3::Y, DVec3::splat(nan), 30.0, 0.5),
        spot(DVec3::Y, DVec3::ZERO, 0.0, 0.5),
        spot(DVec3::Y, DVec3::ZERO, nan, nan),
        spot(DVec3::Y, DVec3::ZERO, 1e9, -3.0),
        spot(DVec3::Y, DVec3::ZERO, -5.0, 7.0),
    ];
    for light in cases {
        // Which refuses a bad sample.
        let (mean, _) = seen_of(&floor(&light), 1, 3);
        assert!(mean.is_finite() && mean >= 0.0, "{light:?}: {mean}");
    }
}
