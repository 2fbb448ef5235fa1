//! Components to packed arrays: what changed, by change detection, and whether it changed anything.

mod lights;
mod materials;
mod meshes;
mod shot;
mod sky;

use bevy_ecs::prelude::*;

use super::Phase;
use super::state::{keep_fault, no_fault};

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(
        (
            materials::extract_changed_materials,
            meshes::extract_changed_meshes.pipe(keep_fault),
            lights::extract_changed_lights,
            sky::extract_changed_sky,
            shot::extract_changed_shot.pipe(keep_fault),
        )
            .chain()
            .in_set(Phase::Extract)
            .run_if(no_fault),
    );
}
