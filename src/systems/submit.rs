//! Plays what was recorded, and learns from the time it took.

use std::time::Instant;

use bevy_ecs::prelude::*;

use super::build::make_tree;
use super::compiling::CompileListener;
use super::governor::Governor;
use super::state::{Batch, Device, Dirty, Frame, PackedScene, Spent, TreeBuilder, keep_fault, no_fault};
use super::{EngineError, Phase};

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(submit_frame.pipe(keep_fault).in_set(Phase::Submit).run_if(no_fault));
}

#[expect(clippy::too_many_arguments, reason = "a system's arguments are what it reads and writes")]
fn submit_frame(
    mut device: ResMut<Device>,
    mut frame: ResMut<Frame>,
    mut spent: ResMut<Spent>,
    mut governor: ResMut<Governor>,
    mut dirty: ResMut<Dirty>,
    batch: Res<Batch>,
    scene: Res<PackedScene>,
    builder: Res<TreeBuilder>,
    listener: Res<CompileListener>,
) -> Result<(), EngineError> {
    let frame = std::mem::take(&mut *frame);
    let recordings = [&frame.build, &frame.trace, &frame.picture];
    // To the end of the frame, for some drivers compile a pass when it first runs.
    let _telling = device.0.lacks(&recordings).then(|| listener.tell());
    device.0.prepare(&recordings)?;
    if dirty.tree {
        let start = Instant::now();
        make_tree(&mut device.0, &frame.build, *builder, scene.triangles)?;
        spent.build += start.elapsed().as_secs_f64();
        governor.forget();
    }
    *dirty = Dirty::default();
    if batch.layers > 0 {
        let start = Instant::now();
        device.0.play(&frame.trace)?;
        device.0.wait()?;
        device.0.check_loops()?;
        let seconds = start.elapsed().as_secs_f64();
        let samples = batch.samples(scene.shot.window_width);
        spent.trace += seconds;
        spent.samples += samples;
        governor.learn(samples, seconds);
    }
    if frame.picture.calls().next().is_some() {
        device.0.play(&frame.picture)?;
        device.0.wait()?;
        device.0.check_loops()?;
    }
    Ok(())
}
