//! Records Morton codes to tree, where triangles changed; and makes the tree, by what was recorded or by its twin.

use bevy_ecs::prelude::*;

use super::Phase;
use super::state::{Dirty, Frame, MeshSlot, PackedScene, TreeBuilder, no_fault};
use crate::cpu;
use crate::gpu::{GpuError, Runtime};
use crate::layout::tree::{Triangle, core_radius};
use crate::passes::{Recording, build};

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(build_changed_tree.in_set(Phase::Build).run_if(no_fault));
}

fn build_changed_tree(mut frame: ResMut<Frame>, scene: Res<PackedScene>, dirty: Res<Dirty>, meshes: Query<&MeshSlot>) {
    if dirty.tree {
        build::record(&mut frame.build, scene.triangles, core_of(&scene, &meshes));
    }
}

/// Makes `leaves` and `nodes` of the first `count` of `triangles`, and waits until they are there. `recording` is what
/// does so on the device, and is prepared: so its passes count as in use, and what is saved of them is compiled and told.
pub(super) fn make_tree(
    device: &mut Runtime,
    recording: &Recording,
    builder: TreeBuilder,
    count: u32,
) -> Result<(), GpuError> {
    if builder == TreeBuilder::Twin && device.runs_shipped(recording) {
        let triangles: Vec<Triangle> = device.read_some("triangles", count as usize)?;
        let tree = cpu::tree::build(&triangles);
        device.write("leaves", 0, &tree.leaves)?;
        return device.write("nodes", 0, &tree.nodes);
    }
    device.play(recording)?;
    device.wait()?;
    device.check_loops()
}

/// What [`core_radius`] says of the scene's triangles.
fn core_of(scene: &PackedScene, meshes: &Query<&MeshSlot>) -> f32 {
    let slots: Vec<&MeshSlot> = scene.meshes.iter().filter_map(|entity| meshes.get(*entity).ok()).collect();
    core_radius(scene.triangles, |triangle| {
        let slot = slots[slots.partition_point(|slot| slot.first + slot.count <= triangle)];
        slot.centre(triangle - slot.first, scene.origin)
    })
}
