//! A point of a floor below a lamp, whose answer is known.

use std::f64::consts::PI;

use glam::{DVec3, UVec2, Vec3};

use super::room::{Room, matte};
use crate::components::{Camera, Energy, Material};
use crate::layout::trace::TraceParams;
use crate::prepare::{camera, material};

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

    /// Of a camera that sees the point alone.
    pub fn params(room: &Room, layers: u32, max_depth: u32) -> TraceParams {
        let size = UVec2::splat(16);
        let mut params = TraceParams { layers, max_depth, ..room.params(size) };
        let position = DVec3::new(0.4, 0.5, 0.7);
        let view = Camera { position, look_at: SEEN, up: DVec3::Y, fov_y: 1e-4, ..Camera::default() };
        camera::aim(&mut params, &view, size, DVec3::ZERO);
        params
    }
}

/// Small lamps above the floor and along it, facing the point and turned from it.
pub fn tiny_lamps() -> [Lamp; 6] {
    // As seen from the point: about 85 degrees from the light's normal, and from the floor's.
    let towards = (OVERHEAD.centre - SEEN).normalize();
    let grazing = towards.any_orthonormal_vector() - 0.09 * towards;
    [
        Lamp { ..OVERHEAD },
        Lamp { one_sided: true, ..OVERHEAD },
        Lamp { normal: DVec3::new(0.3, -0.8, 0.5).normalize(), one_sided: true, ..OVERHEAD },
        Lamp { normal: grazing.normalize(), ..OVERHEAD },
        Lamp { centre: SEEN + DVec3::new(0.6, 0.05, 0.4), ..OVERHEAD },
        Lamp { centre: SEEN + DVec3::new(0.0, 1e-3, 0.0), ..OVERHEAD },
    ]
}
