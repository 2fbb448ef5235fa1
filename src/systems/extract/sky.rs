//! The picture of the environment to pixels and the tables by which directions are drawn from it.

use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::Vec3;

use super::step::Step;
use crate::components::{Environment, EnvironmentItem, EnvironmentMap, Name, rendered_environment};
use crate::gpu::GpuTable;
use crate::layout::alias::AliasColumn;
use crate::layout::sky::SkyTable;
use crate::systems::resources::{Everything, Sky, SkyCell};
use crate::systems::run::counted;

type Touched = (With<Environment>, Or<(Changed<Environment>, Changed<Name>)>);

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_sky.pipe(counted("extract_sky"));
    schedule.add_systems(system.run_if(environment_changed).in_set(Step::Sky));
}

/// An environment came, went, changed or was renamed.
pub fn environment_changed(
    everything: Res<Everything>,
    touched: Query<(), Touched>,
    mut gone: RemovedComponents<Environment>,
    mut unnamed: RemovedComponents<Name>,
) -> bool {
    let removed = gone.read().count() + unnamed.read().count() > 0;
    everything.0 || removed || !touched.is_empty()
}

/// Packs the environment's picture where it is another one, or of another strength or tint. How it is turned, no table says.
fn extract_sky(
    environments: Query<EnvironmentItem>,
    mut sky: ResMut<Sky>,
    mut cells: ResMut<GpuTable<SkyCell>>,
    mut columns: ResMut<GpuTable<AliasColumn>>,
) {
    let Some(Environment::Map { image, strength, tint, .. }) = rendered_environment(environments) else {
        if sky.source.is_some() {
            *sky = Sky::default();
            cells.set(Vec::new());
            columns.set(Vec::new());
        }
        return;
    };
    let factor = *strength * *tint;
    let bits = |factor: Vec3| factor.to_array().map(f32::to_bits);
    let same = |(held, by): &(Arc<EnvironmentMap>, Vec3)| Arc::ptr_eq(held, image) && bits(*by) == bits(factor);
    if sky.source.as_ref().is_some_and(same) {
        return;
    }
    let table = SkyTable::new(image.size, &image.pixels, factor);
    cells.set(table.cells.into_iter().map(SkyCell).collect());
    columns.set(table.columns);
    *sky =
        Sky { source: Some((image.clone(), factor)), size: table.size, power: table.power, brightest: table.brightest };
}
