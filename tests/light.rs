//! Lights of extreme size and brightness, asked directly by the real kernel.

use std::f64::consts::PI;

use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{Camera, Energy, Material};
use lucerna::layout::trace::{SAMPLE_BAD, TraceParams};
use lucerna::prepare::camera;
use lucerna::prepare::material;

use crate::path::samples;
use crate::rooms::{Room, matte};
use crate::support;

/// A floor of 2 x 2 with a camera that sees one point of it, and a square light of a side, tilted, that faces it from one side.
pub struct Lamp {
    pub centre: DVec3,
    pub normal: DVec3,
    pub side: f64,
    pub one_sided: bool,
    pub emission: f32,
}

pub const OVERHEAD: Lamp =
    Lamp { centre: DVec3::new(0.3, 0.8, 0.1), normal: DVec3::NEG_Y, side: 2e-6, one_sided: false, emission: 7.0 };

pub const ALBEDO: f32 = 0.5;
pub const SEEN: DVec3 = DVec3::new(0.1, 0.0, -0.2);

impl Lamp {
    pub fn room(&self) -> Room {
        let mut room = Room { next_event: true, ..Room::default() };
        let floor = room.material(matte(Vec3::splat(ALBEDO), Vec3::ZERO));
        let glow = Material { emission: Vec3::splat(self.emission), one_sided: self.one_sided, ..Material::BLACK };
        let light = room.material(material::pack(&glow, Energy::Preserve));
        room.quad(Vec3::new(-1.0, 0.0, 1.0), 2.0 * Vec3::X, -2.0 * Vec3::Z, floor);
        let (s, t) = self.normal.any_orthonormal_pair();
        let (s, t) = if s.cross(t).dot(self.normal) > 0.0 { (s, t) } else { (t, s) };
        let corner = self.centre - 0.5 * self.side * (s + t);
        room.quad(corner.as_vec3(), (self.side * s).as_vec3(), (self.side * t).as_vec3(), light);
        room
    }

    /// E = L A cos cos / d^2, reflected by a Lambert surface, of the quad as single precision has it.
    pub fn reflected(&self, room: &Room) -> f64 {
        let corners = |i: usize| [room.triangles[i].a, room.triangles[i].b, room.triangles[i].c].map(|v| v.as_dvec3());
        let of_triangle = |[a, b, c]: [DVec3; 3]| {
            let (raw, to_light) = (0.5 * (b - a).cross(c - a), (a + b + c) / 3.0 - SEEN);
            let direction = to_light.normalize();
            raw.dot(direction).abs() * direction.y.max(0.0) / to_light.length_squared()
        };
        let form = of_triangle(corners(2)) + of_triangle(corners(3));
        f64::from(ALBEDO) / PI * f64::from(self.emission) * form
    }
}

/// The mean radiance that leaves the point the camera sees, and its standard error.
fn seen(room: &Room, layers: u32) -> (f64, f64) {
    seen_of(room, layers, 2)
}

/// The same, of paths of so many segments.
pub fn seen_of(room: &Room, layers: u32, max_depth: u32) -> (f64, f64) {
    let mut params = TraceParams { layers, max_depth, ..room.params(UVec2::splat(16)) };
    let view =
        Camera { position: DVec3::new(0.4, 0.5, 0.7), look_at: SEEN, up: DVec3::Y, fov_y: 1e-4, ..Camera::default() };
    camera::aim(&mut params, &view, UVec2::splat(16), DVec3::ZERO);
    let mut rig = support::rig();
    room.load(&mut rig);
    let got = samples(&mut rig, &params);
    let n = got.len() as f64;
    let (mut sum, mut squares) = (0.0, 0.0);
    for sample in got {
        assert_eq!(sample.info & SAMPLE_BAD, 0, "{sample:?}");
        let value = f64::from(sample.rgb.x);
        (sum, squares) = (sum + value, squares + value * value);
    }
    let mean = sum / n;
    (mean, ((squares / n - mean * mean).max(0.0) / n).sqrt())
}

#[test]
fn a_tiny_light_gives_its_irradiance() {
    // As seen from the point: about 85 degrees from the light's normal, and from the floor's.
    let towards = (OVERHEAD.centre - SEEN).normalize();
    let grazing = towards.any_orthonormal_vector() - 0.09 * towards;
    let lamps = [
        Lamp { ..OVERHEAD },
        Lamp { one_sided: true, ..OVERHEAD },
        Lamp { normal: DVec3::new(0.3, -0.8, 0.5).normalize(), one_sided: true, ..OVERHEAD },
        Lamp { normal: grazing.normalize(), ..OVERHEAD },
        Lamp { centre: SEEN + DVec3::new(0.6, 0.05, 0.4), ..OVERHEAD },
        Lamp { centre: SEEN + DVec3::new(0.0, 1e-3, 0.0), ..OVERHEAD },
    ];
    for (case, lamp) in lamps.iter().enumerate() {
        let room = lamp.room();
        let (mean, error) = seen(&room, 16);
        let right = lamp.reflected(&room);
        // 0.1 %, with the noise far below.
        assert!(error < 1e-4 * right, "case {case}: the standard error {error:e} proves nothing of {right:e}");
        assert!((mean / right - 1.0).abs() < 1e-3, "case {case}: {mean:e} seen, {right:e} right");
    }
    // What shines the other way is dark.
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
