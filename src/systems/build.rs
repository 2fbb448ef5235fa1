//! Records Morton codes to tree, where triangles changed; and makes the tree, by what was recorded or by its twin.

use bevy_ecs::prelude::*;
use glam::Vec3;

use super::error::EngineError;
use super::phase::Phase;
use super::resources::{Device, Frame, Tree, TreeBuilder};
use super::run::counted;
use crate::cpu;
use crate::gpu::{GpuError, GpuTable, Runtime};
use crate::layout::tree::{Triangle, core_radius};
use crate::passes::{Recording, build};

pub fn add_systems(schedule: &mut Schedule) {
    let system = build_tree.pipe(counted("build_tree"));
    let missing = |tree: Res<Tree>| !tree.built;
    schedule.add_systems(system.run_if(missing).in_set(Phase::Build));
}

/// Makes room for the tree, and records its making.
fn build_tree(
    mut device: ResMut<Device>,
    mut frame: ResMut<Frame>,
    triangles: Res<GpuTable<Triangle>>,
) -> Result<(), EngineError> {
    let count = triangles.len() as u32;
    for (name, bytes) in build::buffers(count) {
        device.0.reserve(name, bytes)?;
    }
    let core = core_radius(count, |triangle| centre(&triangles.rows()[triangle as usize]));
    build::record(&mut frame.build, count, core);
    Ok(())
}

/// The centre of a triangle's box.
fn centre(triangle: &Triangle) -> Vec3 {
    let Triangle { a, b, c, .. } = *triangle;
    (a.min(b).min(c) + a.max(b).max(c)) * 0.5
}

/// Makes `leaves` and `nodes` of `triangles`, and waits until they are there. `recording` is what
/// does so on the device, and is prepared: so its passes count as in use, and what is saved of them is compiled and told.
pub(super) fn make_tree(
    device: &mut Runtime,
    recording: &Recording,
    builder: TreeBuilder,
    triangles: &[Triangle],
) -> Result<(), GpuError> {
    if builder == TreeBuilder::Twin && device.runs_shipped(recording) {
        let tree = cpu::tree::build(triangles);
        device.write("leaves", 0, &tree.leaves)?;
        return device.write("nodes", 0, &tree.nodes);
    }
    device.play(recording)?;
    device.wait()?;
    device.check_loops()
}
