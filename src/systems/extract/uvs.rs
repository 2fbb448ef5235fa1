//! Texture coordinates and tangents of triangles, where a material looks something up.

use bevy_ecs::prelude::*;

use super::step::Step;
use crate::gpu::{GpuTable, TableRow};
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

/// Makes the rows of those meshes that are others than before; all rows where maps or the number of triangles are. Both tables are empty
/// where nothing is looked up. Of meshes whose material needs none, rows are zero.
fn extract_uvs(
    everything: Res<Everything>,
    geometry: Res<SceneGeometry>,
    meshes: Query<Ref<MeshSlot>>,
    triangles: Res<GpuTable<Triangle>>,
    maps: Res<GpuTable<MaterialMaps>>,
    mut uvs: ResMut<GpuTable<CornerUvs>>,
    mut bent: ResMut<GpuTable<Tangents>>,
) {
    let relief = maps.rows().iter().any(|maps| maps.relief != 0);
    let count = if maps.is_empty() { 0 } else { triangles.len() };
    let tangent_count = if relief { triangles.len() } else { 0 };
    let all = everything.0 || maps.is_changed() || (count, tangent_count) != (uvs.len(), bent.len());
    let mut rows = kept(&uvs, all, count);
    let mut tangent_rows = kept(&bent, all, tangent_count);
    let slots = geometry.meshes.iter().filter_map(|entity| meshes.get(*entity).ok());
    for slot in slots.filter(|slot| all || slot.is_changed()) {
        let own = maps.rows().get(slot.material as usize).copied().unwrap_or_default();
        let range = slot.first as usize..(slot.first + slot.count) as usize;
        if let Some(rows) = rows.get_mut(range.clone()) {
            match own.is_textured() {
                true => {
                    let found = corner_uvs(&slot.geometry, &slot.transform.0);
                    rows.iter_mut().zip(found).for_each(|(row, uvs)| *row = uvs);
                }
                false => rows.fill(CornerUvs::default()),
            }
        }
        if let Some(rows) = tangent_rows.get_mut(range) {
            match own.relief != 0 {
                true => rows.copy_from_slice(&tangents(&slot.geometry, &slot.transform.0)),
                false => rows.fill(Tangents::default()),
            }
        }
    }
    if !uvs.holds(&rows) {
        uvs.set(rows);
    }
    if !bent.holds(&tangent_rows) {
        bent.set(tangent_rows);
    }
}

/// The rows of a table, or so many that are zero, if all are to be made.
fn kept<T: TableRow>(table: &GpuTable<T>, all: bool, count: usize) -> Vec<T> {
    if all { vec![T::zeroed(); count] } else { table.rows().to_vec() }
}
