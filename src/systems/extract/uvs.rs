//! Texture coordinates and tangents of triangles, where a material looks something up.

use bevy_ecs::prelude::*;

use super::step::Step;
use crate::gpu::GpuTable;
use crate::layout::texture::{CornerUvs, MaterialMaps, Tangents};
use crate::layout::tree::Triangle;
use crate::prepare::uvs::{corner_uvs, tangents};
use crate::systems::resources::{Everything, MeshSlot, SceneGeometry};
use crate::systems::run::counted;

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_uvs.pipe(counted("extract_uvs"));
    schedule.add_systems(system.run_if(uvs_changed).in_set(Step::Uvs));
}

/// Triangles or the maps of materials changed.
fn uvs_changed(
    everything: Res<Everything>,
    triangles: Res<GpuTable<Triangle>>,
    maps: Res<GpuTable<MaterialMaps>>,
) -> bool {
    everything.0 || triangles.is_changed() || maps.is_changed()
}

/// Makes both tables anew; empty where nothing is looked up. Of meshes whose material needs none, rows are zero.
fn extract_uvs(
    geometry: Res<SceneGeometry>,
    meshes: Query<&MeshSlot>,
    triangles: Res<GpuTable<Triangle>>,
    maps: Res<GpuTable<MaterialMaps>>,
    mut uvs: ResMut<GpuTable<CornerUvs>>,
    mut bent: ResMut<GpuTable<Tangents>>,
) {
    let relief = maps.rows().iter().any(|maps| maps.relief != 0);
    let mut rows = vec![CornerUvs::default(); if maps.is_empty() { 0 } else { triangles.len() }];
    let mut tangent_rows = vec![Tangents::default(); if relief { triangles.len() } else { 0 }];
    for slot in geometry.meshes.iter().filter_map(|entity| meshes.get(*entity).ok()) {
        let Some(own) = maps.rows().get(slot.material as usize) else { continue };
        let range = slot.first as usize..(slot.first + slot.count) as usize;
        if own.is_textured() {
            let found = corner_uvs(&slot.geometry, &slot.transform.0);
            rows[range.clone()].iter_mut().zip(found).for_each(|(row, uvs)| *row = uvs);
        }
        if own.relief != 0 {
            tangent_rows[range].copy_from_slice(&tangents(&slot.geometry, &slot.transform.0));
        }
    }
    if !uvs.holds(&rows) {
        uvs.set(rows);
    }
    if !bent.holds(&tangent_rows) {
        bent.set(tangent_rows);
    }
}
