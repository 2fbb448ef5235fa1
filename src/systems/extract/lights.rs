//! Emitting triangles and point lights to the table that light sampling draws from.

use std::collections::BTreeMap;
use std::rc::Rc;

use bevy_ecs::prelude::*;
use glam::Vec3;

use super::step::Step;
use super::surfaces::Surfaces;
use crate::components::{Integrator, Name, PointLight, Texture};
use crate::gpu::GpuTable;
use crate::layout::light::{LightRecord, LightTable, PointLightRecord};
use crate::layout::ray::NO_HIT;
use crate::layout::texture::MaterialMaps;
use crate::layout::trace::luminance;
use crate::layout::tree::Triangle;
use crate::prepare;
use crate::systems::resources::{Everything, LightDensity, MeanEmission, Policy, SceneGeometry, TextureSlot};
use crate::systems::run::counted;

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_lights.pipe(counted("extract_lights"));
    schedule.add_systems(system.run_if(lights_changed).in_set(Step::Lights));
}

type TouchedLight = (With<PointLight>, Or<(Changed<PointLight>, Changed<Name>)>);

/// Triangles, records, textures, the integrator or the origin changed, or a point light came, went or changed.
fn lights_changed(
    everything: Res<Everything>,
    surfaces: Surfaces,
    policy: Res<Policy>,
    geometry: Res<SceneGeometry>,
    touched: Query<(), TouchedLight>,
    mut gone: RemovedComponents<PointLight>,
    mut unnamed: RemovedComponents<Name>,
) -> bool {
    let gone = gone.read().count() + unnamed.read().count();
    everything.0
        || gone > 0
        || surfaces.are_others()
        || policy.is_changed()
        || geometry.is_changed()
        || !touched.is_empty()
}

/// What lights are made of.
#[derive(bevy_ecs::system::SystemParam)]
struct Emitting<'w, 's> {
    surfaces: Surfaces<'w>,
    textures: Query<'w, 's, (&'static Texture, &'static TextureSlot)>,
    points: Query<'w, 's, (&'static Name, &'static PointLight)>,
    geometry: Res<'w, SceneGeometry>,
}

/// What comes of them.
#[derive(bevy_ecs::system::SystemParam)]
struct Lit<'w> {
    lights: ResMut<'w, GpuTable<LightRecord>>,
    means: ResMut<'w, GpuTable<MeanEmission>>,
    density: ResMut<'w, LightDensity>,
}

/// Makes the table anew. An integrator that leaves triangles to be hit has point lights in it alone.
fn extract_lights(emitting: Emitting, policy: Res<Policy>, mut lit: Lit) {
    let (records, triangles) = (emitting.surfaces.records.rows(), emitting.surfaces.triangles.rows());
    let emits: Vec<bool> = records.iter().map(|record| record.emission.max_element() > 0.0).collect();
    let points = emitting.points();
    let table = match policy.integrator == Integrator::Path && emits.contains(&true) {
        true => {
            let shines = |triangle: &&Triangle| emits.get(triangle.material as usize).is_some_and(|emits| *emits);
            let mapped = emitting.mapped(&emits);
            let emission = |triangle: &Triangle| emitting.mean(triangle, &mapped);
            let sent = triangles.iter().filter(shines).map(|triangle| (*triangle, emission(triangle)));
            LightTable::of(sent, records, &points)
        }
        false => LightTable::of(std::iter::empty(), records, &points),
    };
    let mut means = Vec::new();
    if !table.lights.is_empty() && emitting.surfaces.maps.rows().iter().any(|maps| maps.emission != 0) {
        means.resize(triangles.len(), MeanEmission(0.0));
        for light in table.lights.iter().filter(|light| light.triangle != NO_HIT) {
            means[light.triangle as usize].0 = luminance(light.emission);
        }
    }
    if !lit.lights.holds(&table.lights) {
        lit.lights.set(table.lights);
    }
    if !lit.means.holds(&means) {
        lit.means.set(means);
    }
    lit.density.set_if_neq(LightDensity(table.density));
}

impl Emitting<'_, '_> {
    /// Point lights in the order of their names.
    fn points(&self) -> Vec<PointLightRecord> {
        let mut points: Vec<_> = self.points.iter().collect();
        points.sort_by_key(|(name, _)| name.as_str());
        points.into_iter().map(|(_, light)| prepare::point::point_light(light, self.geometry.origin)).collect()
    }

    /// The map of emission of each material that emits, ready to be averaged.
    fn mapped(&self, emits: &[bool]) -> Vec<Option<Rc<prepare::texture::MeanEmission>>> {
        let mut read: BTreeMap<u32, Rc<prepare::texture::MeanEmission>> = BTreeMap::new();
        let mut of = |(maps, emits): (&MaterialMaps, &bool)| {
            let index = maps.emission.checked_sub(1).filter(|_| *emits)?;
            let texture = self.textures.iter().find(|(_, slot)| slot.index == index)?.0;
            Some(read.entry(index).or_insert_with(|| Rc::new(prepare::texture::mean_emission(texture))).clone())
        };
        self.surfaces.maps.rows().iter().zip(emits).map(&mut of).collect()
    }

    /// What a triangle sends out on average.
    fn mean(&self, triangle: &Triangle, mapped: &[Option<Rc<prepare::texture::MeanEmission>>]) -> Vec3 {
        let material = triangle.material as usize;
        let emission = self.surfaces.records.rows()[material].emission;
        match (mapped.get(material), self.surfaces.uvs.rows().get(triangle.index as usize)) {
            (Some(Some(map)), Some(uvs)) => emission * map.over([uvs.a, uvs.a + uvs.b, uvs.a + uvs.c]),
            _ => emission,
        }
    }
}
