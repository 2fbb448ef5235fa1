//! What had been done before a film begins: what is not done again for it is told by that.

use bevy_ecs::prelude::*;

use super::step::Step;
use crate::systems::resources::{Device, DoneBefore, Spent, film_has_not_begun};

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(note_beginning.run_if(film_has_not_begun).in_set(Step::Beginning));
}

/// Takes note of the counts, before anything is sent or built for the film.
fn note_beginning(device: Res<Device>, spent: Res<Spent>, mut before: ResMut<DoneBefore>) {
    *before = DoneBefore {
        uploads: device.0.uploads().clone(),
        dispatches: device.0.dispatches().clone(),
        build: spent.build,
    };
}
