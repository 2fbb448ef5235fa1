//! Materials to records, by the order of their names.

use bevy_ecs::prelude::*;

use crate::components::{Energy, Material, Name, Passage, Render, Specular};
use crate::layout::trace::{EnergyRule, MaterialRecord, Reflector};
use crate::systems::state::{Dirty, PackedScene, Pending};

type Touched = Or<(Changed<Material>, Changed<Name>)>;

/// Repacks all records where a material came, went, changed or was renamed, or the energy policy changed; sends on only
/// those that are not what they were.
#[expect(clippy::too_many_arguments, reason = "a system's arguments are what it reads and writes")]
pub fn extract_changed_materials(
    materials: Query<(Entity, &Name, &Material)>,
    changed: Query<(), (With<Material>, Touched)>,
    mut removed: RemovedComponents<Material>,
    mut unnamed: RemovedComponents<Name>,
    render: Query<Ref<Render>>,
    mut scene: ResMut<PackedScene>,
    mut pending: ResMut<Pending>,
    mut dirty: ResMut<Dirty>,
) {
    let removed = removed.read().count() + unnamed.read().count() > 0;
    if scene.sent && !removed && changed.is_empty() && !render.iter().any(|r| r.is_changed()) {
        return;
    }
    let rule = match render.iter().next().map(|r| r.energy).unwrap_or_default() {
        Energy::Preserve => EnergyRule::Preserve,
        Energy::AsWritten => EnergyRule::AsWritten,
    };
    let mut sorted: Vec<_> = materials.iter().collect();
    sorted.sort_by(|a, b| (a.1.as_str(), a.0).cmp(&(b.1.as_str(), b.0)));
    let records: Vec<MaterialRecord> =
        sorted.iter().map(|(_, _, m)| pack(m, rule)).chain([pack(&Material::default(), rule)]).collect();
    let order: Vec<Entity> = sorted.iter().map(|(entity, ..)| *entity).collect();
    if order != scene.materials {
        scene.material_index = order.iter().zip(0..).map(|(entity, i)| (*entity, i)).collect();
        scene.materials = order;
    }
    if !scene.sent || records.len() != scene.records.len() {
        pending.materials = vec![(0, records.clone())];
        dirty.film = true;
    } else {
        for (i, record) in records.iter().enumerate() {
            if *record != scene.records[i] {
                pending.materials.push((i as u32, vec![*record]));
                dirty.film = true;
            }
        }
    }
    scene.records = records;
}

fn pack(material: &Material, rule: EnergyRule) -> MaterialRecord {
    let values = Reflector {
        kd: material.kd,
        ks: material.ks,
        ns: material.ns,
        roughness: material.roughness,
        metallic: material.metallic,
        mirror: material.specular() == Specular::Mirror,
        dielectric: material.passage() == Passage::Glass,
        ni: material.ni,
        tf: material.tf,
        opacity: material.dissolve,
        emission: material.emission,
        one_sided: material.one_sided,
    };
    MaterialRecord::pack(&values, rule)
}
