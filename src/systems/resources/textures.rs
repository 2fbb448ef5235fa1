//! Where textures are on the device, and what was done to make them fit.

use bevy_ecs::prelude::*;
use glam::UVec2;

use super::scene::{MeanEmission, Texel};
use crate::components::Texture;
use crate::cpu::texture::TextureSet;
use crate::gpu::{GpuTable, TableRow};
use crate::layout::texture::TextureRecord;

/// Where a texture is: by the order of names of those that are used.
#[derive(Component, Clone, Debug)]
pub struct TextureSlot {
    /// Of its record.
    pub index: u32,
    /// With its first word.
    pub record: TextureRecord,
    /// Levels, from the first, that are left out.
    pub halvings: u32,
    /// What the words were made from.
    pub source: Texture,
    /// The largest channel of any texel; none where it is no map of emission.
    pub brightest: Option<f32>,
}

/// What all textures come to.
#[derive(Resource, Default, Clone, Debug, PartialEq)]
pub struct Textures {
    /// Of each record, the largest channel of any texel; 0 where it is no map of emission.
    pub brightest: Vec<f32>,
    pub uses: Vec<TextureUse>,
    /// Textures that no mesh uses, and the bytes that they would take.
    pub unused: u32,
    pub unused_bytes: u64,
    /// Bytes that those in use would take beyond what they do, without being halved.
    pub halved_bytes: u64,
}

/// What one texture takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextureUse {
    pub name: String,
    /// Texels of the picture.
    pub size: UVec2,
    /// How often it is halved, for a setting or for want of room.
    pub halvings: u32,
    /// How many of these times for want of room.
    pub for_room: u32,
    pub bytes: u64,
}

/// What the twin looks textures up in: what the kernel is given of them.
pub fn texture_set(world: &World) -> TextureSet<'_> {
    TextureSet {
        records: table(world),
        words: bytemuck::cast_slice(table::<Texel>(world)),
        maps: table(world),
        uvs: table(world),
        tangents: table(world),
        mean_emission: bytemuck::cast_slice(table::<MeanEmission>(world)),
    }
}

fn table<T: TableRow>(world: &World) -> &[T] {
    world.resource::<GpuTable<T>>().rows()
}
