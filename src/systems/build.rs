//! Records Morton codes to tree, where triangles changed; and makes the tree, by what was recorded or by its twin.

use bevy_ecs::prelude::*;

use super::error::EngineError;
use super::phase::Phase;
use super::resources::{Device, Frame, Tree, TreeBuilder};
use super::run::counted;
use crate::gpu::{GpuError, GpuTable, Runtime};
use crate::layout::tree::Triangle;
use crate::passes::Recording;
use crate::passes::tree::PLAN;

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
    for (name, bytes) in (PLAN.buffers)(triangles.len() as u32) {
        device.0.reserve(name, bytes)?;
    }
    (PLAN.record)(&mut frame.build, triangles.rows());
    Ok(())
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
        let mut written = Ok(());
        (PLAN.twin)(triangles, &mut |buffer, bytes| {
            if written.is_ok() {
                written = device.write(buffer, 0, bytes);
            }
        });
        return written;
    }
    device.play(recording)?;
    device.wait()?;
    device.check_loops()
}
