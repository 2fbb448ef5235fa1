//! Records Morton codes to tree, where triangles changed and are enough for one.

use bevy_ecs::prelude::*;

use super::Phase;
use super::state::{Dirty, Frame, PackedScene, no_fault};
use crate::passes::build;
use crate::passes::trace::needs_tree;

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(build_changed_tree.in_set(Phase::Build).run_if(no_fault));
}

fn build_changed_tree(mut frame: ResMut<Frame>, scene: Res<PackedScene>, dirty: Res<Dirty>) {
    if dirty.tree && needs_tree(scene.triangles) {
        build::record(&mut frame.build, scene.triangles);
    }
}
