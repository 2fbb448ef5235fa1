//! What is known of surfaces, as the kernel reads it: all that lights and films are made of has these.

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;

use crate::gpu::GpuTable;
use crate::layout::texture::{CornerUvs, MaterialMaps};
use crate::layout::trace::MaterialRecord;
use crate::layout::tree::Triangle;
use crate::systems::resources::Texel;

/// Triangles, their materials, and what these look up.
#[derive(SystemParam)]
pub struct Surfaces<'w> {
    pub triangles: Res<'w, GpuTable<Triangle>>,
    pub records: Res<'w, GpuTable<MaterialRecord>>,
    pub maps: Res<'w, GpuTable<MaterialMaps>>,
    pub uvs: Res<'w, GpuTable<CornerUvs>>,
    texels: Res<'w, GpuTable<Texel>>,
}

impl Surfaces<'_> {
    /// Whether any of it is another one.
    pub fn are_others(&self) -> bool {
        self.triangles.is_changed()
            || self.records.is_changed()
            || self.maps.is_changed()
            || self.uvs.is_changed()
            || self.texels.is_changed()
    }
}
