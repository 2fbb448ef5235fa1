//! A floor under lamps, and what may hide them.

use glam::{UVec2, Vec3};

use super::room::{Room, matte};
use crate::components::{Energy, Material};
use crate::layout::trace::TraceParams;
use crate::prepare::material;

/// A floor of 4 x 4 under lamps of 3 x 3 at height 1, all of them moved and scaled, seen from the side.
pub struct Covered {
    /// From the floor's middle, before scaling.
    pub offset: Vec3,
    pub scale: f32,
    pub one_sided: bool,
    /// Radiances of lamps in one place.
    pub lamps: Vec<Vec3>,
    /// A black sheet so far below them, by part of the height, or above, if negative.
    pub gap: Option<f32>,
}

pub const PLAIN: Covered = Covered { offset: Vec3::ZERO, scale: 1.0, one_sided: false, lamps: Vec::new(), gap: None };

impl Covered {
    pub fn room(&self) -> Room {
        let place = |p: Vec3| (p + self.offset) * self.scale;
        let mut room = Room::default();
        let floor = room.material(matte(Vec3::splat(0.5), Vec3::ZERO));
        let (x, z) = (Vec3::X * self.scale, Vec3::Z * self.scale);
        room.quad(place(Vec3::new(-2.0, 0.0, 2.0)), 4.0 * x, -4.0 * z, floor);
        for emission in &self.lamps {
            let glow = Material { emission: *emission, one_sided: self.one_sided, ..Material::BLACK };
            let lamp = room.material(material::pack(&glow, Energy::Preserve));
            room.quad(place(Vec3::new(-1.5, 1.0, -1.5)), 3.0 * x, 3.0 * z, lamp);
        }
        if let Some(gap) = self.gap {
            let cover = room.material(matte(Vec3::ZERO, Vec3::ZERO));
            room.quad(place(Vec3::new(-2.0, 1.0 - gap, 2.0)), 4.0 * x, -4.0 * z, cover);
        }
        room
    }

    pub fn params(&self, room: &Room, layers: u32) -> TraceParams {
        let position = (Vec3::new(0.0, 0.6, 3.0) + self.offset) * self.scale;
        TraceParams { position, layers, max_depth: 2, ..room.params(UVec2::splat(8)) }
    }
}
