//! The order of the schedule.

use bevy_ecs::prelude::*;

/// The phases, in order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Phase {
    /// Puts in place what was saved and compiled since the last run.
    Reload,
    /// Refuses what the device has no room for.
    Room,
    /// Components to tables and parameters, and what they make start anew.
    Extract,
    /// Tables to buffers.
    Upload,
    /// Records Morton codes to tree, where there is none of the triangles as they are.
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
