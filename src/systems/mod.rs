//! One file a phase of the schedule.
//!
//! `Reload -> Extract -> Upload -> Build -> Trace -> Accumulate -> Present -> Submit`. Extract finds what changed by change
//! detection, and compares values, so that an edit which changes nothing resets nothing. Each later phase does only what
//! an earlier one left for it in [`state`].

mod accumulate;
mod build;
pub mod compiling;
mod engine;
mod extract;
mod governor;
pub mod inspect;
pub mod lint;
pub mod present;
pub mod reload;
mod report;
pub mod state;
mod submit;
mod trace;
mod upload;

use bevy_ecs::prelude::*;

pub use engine::{Engine, EngineError, Progress};
pub use report::{FilmImage, Report};

/// The phases, in order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Phase {
    /// Puts in place what was saved and compiled since the last run.
    Reload,
    /// Components to packed arrays, and to a list of what they change.
    Extract,
    /// Packed arrays to buffers.
    Upload,
    /// Records Morton codes to tree, where triangles changed.
    Build,
    /// Records a batch of samples, where the film is not finished.
    Trace,
    /// Records their addition to the film.
    Accumulate,
    /// Records the picture of a finished film, or of any that is watched, where that or the way it is shown changed;
    /// or a view of what is seen first.
    Present,
    /// Plays what was recorded, and learns from the time it took.
    Submit,
}

/// The one schedule.
pub fn schedule() -> Schedule {
    let mut schedule = Schedule::default();
    schedule.configure_sets(
        (
            Phase::Reload,
            Phase::Extract,
            Phase::Upload,
            Phase::Build,
            Phase::Trace,
            Phase::Accumulate,
            Phase::Present,
            Phase::Submit,
        )
            .chain(),
    );
    reload::add_systems(&mut schedule);
    extract::add_systems(&mut schedule);
    upload::add_systems(&mut schedule);
    build::add_systems(&mut schedule);
    trace::add_systems(&mut schedule);
    accumulate::add_systems(&mut schedule);
    present::add_systems(&mut schedule);
    submit::add_systems(&mut schedule);
    schedule
}
