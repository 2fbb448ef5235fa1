//! Values of shaders' parameters: what reads another one than before is made anew, and nothing is compiled.

use bevy_ecs::prelude::*;

use super::step::Step;
use crate::components::{Film, ShaderValues};
use crate::gpu::Values;
use crate::systems::code::{restart_for_code, restarts_of};
use crate::systems::resources::{Device, FilmProgress, Governor, Tree};
use crate::systems::run::counted;

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_values.pipe(counted("extract_values"));
    schedule.add_systems(system.run_if(values_changed).in_set(Step::Film));
}

fn values_changed(
    films: Query<(), (With<Film>, Changed<ShaderValues>)>,
    mut gone: RemovedComponents<ShaderValues>,
) -> bool {
    gone.read().count() > 0 || !films.is_empty()
}

fn extract_values(
    films: Query<&ShaderValues, With<Film>>,
    mut device: ResMut<Device>,
    mut tree: ResMut<Tree>,
    mut progress: Single<&mut FilmProgress, With<Film>>,
    mut governor: ResMut<Governor>,
) {
    let set = films.iter().next().into_iter().flat_map(|values| &values.0);
    let values: Values = set.map(|(name, value)| (name.clone(), value.number())).collect();
    if *device.0.values() != values {
        let changed = device.0.set_values(values);
        restart_for_code(restarts_of(&changed), &mut tree, &mut progress, &mut governor);
    }
}
