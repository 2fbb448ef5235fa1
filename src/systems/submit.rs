//! Plays what was recorded, and learns from the time it took.

use std::time::Instant;

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;

use super::build::make_tree;
use super::error::EngineError;
use super::phase::Phase;
use super::resources::{Batch, CompileListener, Device, Frame, Governor, Shot, Spent, Tree, TreeBuilder};
use super::run::counted;
use crate::gpu::{GpuTable, Runtime};
use crate::layout::tree::Triangle;
use crate::passes::Recording;

pub fn add_systems(schedule: &mut Schedule) {
    let system = submit_frame.pipe(counted("submit_frame"));
    schedule.add_systems(system.run_if(is_recorded).in_set(Phase::Submit));
}

/// There is something to play.
fn is_recorded(frame: Res<Frame>, tree: Res<Tree>) -> bool {
    !tree.built || !frame.trace.is_empty() || !frame.picture.is_empty()
}

/// What this run of the schedule has planned.
#[derive(SystemParam)]
struct Planned<'w> {
    batch: Res<'w, Batch>,
    shot: Res<'w, Shot>,
    triangles: Res<'w, GpuTable<Triangle>>,
    builder: Res<'w, TreeBuilder>,
}

/// What is learnt from playing.
#[derive(SystemParam)]
struct Learnt<'w> {
    tree: ResMut<'w, Tree>,
    spent: ResMut<'w, Spent>,
    governor: ResMut<'w, Governor>,
}

/// The tree by itself, so that its time is known; then the batch; then the picture.
fn submit_frame(
    mut device: ResMut<Device>,
    mut frame: ResMut<Frame>,
    planned: Planned,
    mut learnt: Learnt,
    listener: Res<CompileListener>,
) -> Result<(), EngineError> {
    let (device, frame) = (&mut device.0, std::mem::take(&mut *frame));
    let recordings = [&frame.build, &frame.trace, &frame.picture];
    // To the end of the frame, for some drivers compile a pass when it first runs.
    let _telling = device.lacks(&recordings).then(|| listener.tell());
    let start = Instant::now();
    device.prepare(&recordings)?;
    learnt.spent.compile += start.elapsed().as_secs_f64();
    if !learnt.tree.built {
        let start = Instant::now();
        make_tree(device, &frame.build, *planned.builder, planned.triangles.rows())?;
        learnt.tree.built = true;
        learnt.spent.last_build = start.elapsed().as_secs_f64();
        learnt.spent.build += learnt.spent.last_build;
        learnt.governor.forget();
    }
    if !frame.trace.is_empty() {
        let start = Instant::now();
        play(device, &frame.trace)?;
        let seconds = start.elapsed().as_secs_f64();
        let samples = planned.batch.samples(planned.shot.size());
        learnt.spent.trace += seconds;
        learnt.spent.film += seconds;
        learnt.spent.samples += samples;
        if !planned.batch.is_remainder() {
            learnt.governor.learn(samples, seconds);
        }
    }
    if !frame.picture.is_empty() {
        let start = Instant::now();
        play(device, &frame.picture)?;
        learnt.spent.picture += start.elapsed().as_secs_f64();
    }
    Ok(())
}

/// Plays a recording to its end.
fn play(device: &mut Runtime, recording: &Recording) -> Result<(), EngineError> {
    device.play(recording)?;
    device.wait()?;
    Ok(device.check_loops()?)
}
