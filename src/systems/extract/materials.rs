//! Materials to records, by the order of their names.

use bevy_ecs::prelude::*;

use super::step::Step;
use crate::components::{Maps, Material, Name};
use crate::gpu::GpuTable;
use crate::layout::texture::MaterialMaps;
use crate::layout::trace::MaterialRecord;
use crate::prepare;
use crate::systems::resources::{Everything, MaterialSlot, Policy, Relief, TextureSlot, Textures};
use crate::systems::run::counted;

type Touched = (With<Material>, Or<(Changed<Material>, Changed<Maps>, Changed<Name>)>);
type Surface<'a> = (Entity, &'a Name, &'a Material, Option<&'a Maps>, Option<&'a MaterialSlot>);
type Stray = (With<MaterialSlot>, Or<(Without<Material>, Without<Name>)>);

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_materials.pipe(counted("extract_materials"));
    schedule.add_systems(system.run_if(materials_changed).in_set(Step::Materials));
}

/// A material came, went, changed or was renamed, its textures have other places, or the policy changed.
fn materials_changed(
    everything: Res<Everything>,
    touched: Query<(), Touched>,
    mut gone: RemovedComponents<Material>,
    mut unnamed: RemovedComponents<Name>,
    mut unmapped: RemovedComponents<Maps>,
    textures: Res<Textures>,
    policy: Res<Policy>,
) -> bool {
    let removed = gone.read().count() + unnamed.read().count() + unmapped.read().count() > 0;
    everything.0 || removed || policy.is_changed() || textures.is_changed() || !touched.is_empty()
}

/// What comes of materials.
#[derive(bevy_ecs::system::SystemParam)]
struct Packed<'w> {
    records: ResMut<'w, GpuTable<MaterialRecord>>,
    maps: ResMut<'w, GpuTable<MaterialMaps>>,
    relief: ResMut<'w, Relief>,
}

/// Packs all records, and gives each material the slot that its name's place in the order says.
fn extract_materials(
    materials: Query<Surface>,
    textures: Query<&TextureSlot>,
    stray: Query<Entity, Stray>,
    policy: Res<Policy>,
    mut packed: Packed,
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
    let pack = |material: &Material, maps: MaterialMaps| {
        let record = prepare::material::pack(material, policy.energy);
        let (record, maps) = prepare::texture::pack_maps(material, record, maps, policy.energy, policy.diffuse_map);
        (record, MaterialMaps { shown: maps.first(), ..maps })
    };
    let all = sorted.iter().map(|(_, _, material, maps, _)| pack(material, places(maps.copied(), &textures)));
    let all = all.chain([pack(&Material::default(), MaterialMaps::default())]);
    let (records, mut maps): (Vec<MaterialRecord>, Vec<MaterialMaps>) = all.unzip();
    if !maps.iter().any(MaterialMaps::is_textured) {
        maps.clear();
    }
    packed.relief.set_if_neq(Relief(maps.iter().any(|maps| maps.relief != 0)));
    if !packed.records.holds(&records) {
        packed.records.set(records);
    }
    if !packed.maps.holds(&maps) {
        packed.maps.set(maps);
    }
}

/// The textures of a material by the places of their records.
fn places(maps: Option<Maps>, textures: &Query<&TextureSlot>) -> MaterialMaps {
    let place = |entity: Option<Entity>| entity.and_then(|e| textures.get(e).ok()).map_or(0, |slot| slot.index + 1);
    let maps = maps.unwrap_or_default();
    MaterialMaps {
        diffuse: place(maps.diffuse),
        specular: place(maps.specular),
        lobe: place(maps.lobe),
        metallic: place(maps.metallic),
        emission: place(maps.emission),
        opacity: place(maps.opacity),
        relief: place(maps.relief),
        ..MaterialMaps::default()
    }
}
