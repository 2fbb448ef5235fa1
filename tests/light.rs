//! Lights of extreme size and brightness, asked directly by the real kernel.

use std::f64::consts::PI;

use glam::DVec3;
pub use lucerna::stress::scenes::lamp::{ALBEDO, Lamp, OVERHEAD, SEEN};
use lucerna::stress::tools::lamps;

use crate::rooms::Room;
use crate::support;

/// The mean radiance that leaves the point the camera sees, and its standard error.
fn seen(room: &Room, layers: u32) -> (f64, f64) {
    seen_of(room, layers, 2)
}

/// The same, of paths of so many segments.
pub fn seen_of(room: &Room, layers: u32, max_depth: u32) -> (f64, f64) {
    lamps::seen(&support::lab(), room, layers, max_depth).unwrap()
}

#[test]
fn a_light_that_shines_the_other_way_is_dark() {
    let away = Lamp { normal: DVec3::Y, one_sided: true, ..OVERHEAD };
    assert_eq!(seen(&away.room(), 1).0, 0.0);
}

#[test]
fn a_light_too_dim_for_a_density_is_left_to_be_hit() {
    // A power of 2e-39: the density by area is beyond f32, and as infinity would take all weight from both ways to find it.
    for (emission, asked) in [(1e-33, true), (1e-35, false)] {
        let centre = SEEN + DVec3::new(0.0, 0.01, 0.0);
        let lamp = Lamp { centre, normal: DVec3::NEG_Y, side: 0.01, emission, ..OVERHEAD };
        let room = lamp.room();
        assert_eq!(!room.lights().lights.is_empty(), asked, "emission {emission:e}");
        let (mean, error) = seen(&room, 1024);
        // Of a square at half its width from a point below its middle.
        let x = 1.25f64.sqrt().recip() * 0.5;
        let right = f64::from(ALBEDO * emission) * 4.0 / PI * x * x.atan();
        assert!((mean - right).abs() < 5.0 * error + 1e-4 * right && error < 0.01 * right, "{mean:e}, {right:e} right");
    }
}
