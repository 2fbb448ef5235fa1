//! Components to tables and parameters: each system runs where change detection says that it has something to do, and
//! compares, so that an edit that changes nothing changes no table.

mod beginning;
mod film;
mod lights;
mod materials;
mod meshes;
mod settings;
mod shot;
mod sky;
mod step;
mod surfaces;
mod textures;
mod uvs;
mod values;

use bevy_ecs::prelude::*;

use super::error::no_fault;
use super::phase::Phase;
use super::resources::Everything;
use step::Step;

pub fn add_systems(schedule: &mut Schedule) {
    settings::add_systems(schedule);
    textures::add_systems(schedule);
    materials::add_systems(schedule);
    meshes::add_systems(schedule);
    uvs::add_systems(schedule);
    lights::add_systems(schedule);
    sky::add_systems(schedule);
    shot::add_systems(schedule);
    film::add_systems(schedule);
    values::add_systems(schedule);
    beginning::add_systems(schedule);
    schedule.configure_sets(
        (
            Step::Settings,
            Step::Textures,
            Step::Materials,
            Step::Meshes,
            Step::Uvs,
            Step::Lights,
            Step::Sky,
            Step::Shot,
            Step::Film,
            Step::Beginning,
        )
            .chain()
            .in_set(Phase::Extract),
    );
    let extracted = |mut everything: ResMut<Everything>| everything.0 = false;
    schedule.add_systems(extracted.after(Phase::Extract).before(Phase::Upload).run_if(no_fault).run_if(everything));
}

/// Run condition: everything is to be extracted again.
fn everything(everything: Res<Everything>) -> bool {
    everything.0
}
