//! Components to packed arrays: what changed, by change detection, and whether it changed anything.

mod materials;
mod meshes;
mod shot;

use bevy_ecs::prelude::*;

use super::Phase;
use super::state::{keep_fault, no_fault};

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(
        (
            materials::extract_changed_materials,
            meshes::extract_changed_meshes.pipe(keep_fault),
            shot::extract_changed_shot.pipe(keep_fault),
        )
            .chain()
            .in_set(Phase::Extract)
            .run_if(no_fault),
    );
}
