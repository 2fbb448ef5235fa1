//! Materials to records, by the order of their names.

use bevy_ecs::prelude::*;

use super::step::Step;
use crate::components::{Material, Name};
use crate::gpu::GpuTable;
use crate::layout::trace::MaterialRecord;
use crate::prepare;
use crate::systems::resources::{Everything, MaterialSlot, Policy};
use crate::systems::run::counted;

type Touched = (With<Material>, Or<(Changed<Material>, Changed<Name>)>);
type Stray = (With<MaterialSlot>, Or<(Without<Material>, Without<Name>)>);

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_materials.pipe(counted("extract_materials"));
    schedule.add_systems(system.run_if(materials_changed).in_set(Step::Materials));
}

/// A material came, went, changed or was renamed, or the energy policy changed.
fn materials_changed(
    everything: Res<Everything>,
    touched: Query<(), Touched>,
    mut gone: RemovedComponents<Material>,
    mut unnamed: RemovedComponents<Name>,
    policy: Res<Policy>,
) -> bool {
    let removed = gone.read().count() + unnamed.read().count() > 0;
    everything.0 || removed || policy.is_changed() || !touched.is_empty()
}

/// Packs all records, and gives each material the slot that its name's place in the order says.
fn extract_materials(
    materials: Query<(Entity, &Name, &Material, Option<&MaterialSlot>)>,
    stray: Query<Entity, Stray>,
    policy: Res<Policy>,
    mut records: ResMut<GpuTable<MaterialRecord>>,
    mut commands: Commands,
) {
    for entity in &stray {
        commands.entity(entity).remove::<MaterialSlot>();
    }
    let mut sorted: Vec<_> = materials.iter().collect();
    sorted.sort_by(|a, b| (a.1.as_str(), a.0).cmp(&(b.1.as_str(), b.0)));
    for ((entity, .., held), index) in sorted.iter().zip(0..) {
        if *held != Some(&MaterialSlot(index)) {
            commands.entity(*entity).insert(MaterialSlot(index));
        }
    }
    let pack = |material: &Material| prepare::material::pack(material, policy.energy);
    let packed = sorted.iter().map(|(_, _, material, _)| pack(material));
    let packed: Vec<MaterialRecord> = packed.chain([pack(&Material::default())]).collect();
    if !records.holds(&packed) {
        records.set(packed);
    }
}
