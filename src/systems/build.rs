//! Records Morton codes to tree, where triangles changed.

use bevy_ecs::prelude::*;

use super::Phase;
use super::state::{Dirty, Frame, PackedScene, no_fault};
use crate::passes::build;

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(build_changed_tree.in_set(Phase::Build).run_if(no_fault));
}

fn build_changed_tree(mut frame: ResMut<Frame>, scene: Res<PackedScene>, dirty: Res<Dirty>) {
    if dirty.tree {
        build::record(&mut frame.build, scene.triangles);
    }
}
