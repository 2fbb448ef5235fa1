//! What the settings say of materials and lights, apart from all else that they say.

use bevy_ecs::prelude::*;

use super::step::Step;
use crate::components::{Film, Render};
use crate::systems::resources::Policy;
use crate::systems::run::counted;

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_policy.pipe(counted("extract_policy"));
    schedule.add_systems(system.run_if(any_match_filter::<Changed<Render>>).in_set(Step::Settings));
}

fn extract_policy(renders: Query<&Render, With<Film>>, mut policy: ResMut<Policy>) {
    let render = renders.iter().next().copied().unwrap_or_default();
    let Render { energy, integrator, diffuse_map, texture_size, .. } = render;
    policy.set_if_neq(Policy { energy, integrator, diffuse_map, texture_size });
}
