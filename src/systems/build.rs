//! Records Morton codes to tree, where triangles changed.

use bevy_ecs::prelude::*;

use super::Phase;
use super::state::{Dirty, Frame, MeshSlot, PackedScene, no_fault};
use crate::layout::tree::core_radius;
use crate::passes::build;

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(build_changed_tree.in_set(Phase::Build).run_if(no_fault));
}

fn build_changed_tree(mut frame: ResMut<Frame>, scene: Res<PackedScene>, dirty: Res<Dirty>, meshes: Query<&MeshSlot>) {
    if dirty.tree {
        build::record(&mut frame.build, scene.triangles, core_of(&scene, &meshes));
    }
}

/// What [`core_radius`] says of the scene's triangles.
fn core_of(scene: &PackedScene, meshes: &Query<&MeshSlot>) -> f32 {
    let slots: Vec<&MeshSlot> = scene.meshes.iter().filter_map(|entity| meshes.get(*entity).ok()).collect();
    core_radius(scene.triangles, |triangle| {
        let slot = slots[slots.partition_point(|slot| slot.first + slot.count <= triangle)];
        slot.centre(triangle - slot.first, scene.origin)
    })
}
