//! The device, what is recorded for it, and how long it may take.

use std::time::Duration;

use bevy_ecs::prelude::*;

use crate::gpu::{Gpu, Runtime};
use crate::layout::view::ViewMode;
use crate::passes::Recording;
use crate::passes::probe::ProbeLook;

/// The device and all that is on it.
#[derive(Resource)]
pub struct Device(pub Runtime);

/// Who builds the tree. Both build the same, to the bit.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeBuilder {
    /// The passes.
    Passes,
    /// Their twin on the processor, as long as nobody has edited the passes.
    Twin,
}

impl TreeBuilder {
    /// The twin, where the device is the processor anyway: the twin is faster there, and drivers take up to a third of a minute
    /// to compile the passes.
    pub fn of(gpu: &Gpu) -> Self {
        if gpu.is_software() { TreeBuilder::Twin } else { TreeBuilder::Passes }
    }
}

/// The tree over the scene's triangles.
#[derive(Resource, Default, Clone, Copy, Debug)]
pub struct Tree {
    /// It is there, and of the triangles as they are.
    pub built: bool,
}

/// Dispatches recorded in this run of the schedule.
#[derive(Resource, Default)]
pub struct Frame {
    /// Morton codes to tree: played by itself, so that its time is known.
    pub build: Recording,
    pub trace: Recording,
    /// The picture of the film: played by itself, so that its time is not taken for that of samples.
    pub picture: Recording,
}

/// Beside the film, its samples are summed in blocks: what a robust mean is made of.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Robust(pub bool);

/// The picture follows the film batch by batch, for a user who watches.
#[derive(Resource, Default)]
pub struct Live(pub bool);

/// What the picture is to show.
#[derive(Resource, Default)]
pub struct Viewed(pub ViewMode);

/// A name that shaders show numbers by, and how these are looked at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Probing {
    pub name: String,
    pub look: ProbeLook,
}

/// The name that was chosen.
#[derive(Resource, Default)]
pub struct ProbeChosen(pub Option<Probing>);

impl ProbeChosen {
    /// Its number in the code that runs; none where no name was chosen, or no code has it.
    pub fn number(&self, device: &Runtime) -> Option<u32> {
        let chosen = self.0.as_ref()?;
        let place = device.probes().iter().position(|probe| probe.name == chosen.name)?;
        u32::try_from(place).ok()
    }
}

/// Time this run of the schedule may take on the GPU.
#[derive(Resource)]
pub struct Budget(pub Duration);

/// Seconds spent so far.
#[derive(Resource, Default, Clone, Copy, Debug)]
pub struct Spent {
    /// All of what steps took: what is in none of the following is extraction and sending.
    pub steps: f64,
    /// Linking, validating and compiling shaders that were missing.
    pub compile: f64,
    pub build: f64,
    /// Of `build`, the last tree.
    pub last_build: f64,
    pub trace: f64,
    /// Pictures of the film, and views.
    pub picture: f64,
    /// Of `trace`, what the film took that there is.
    pub film: f64,
    /// Samples over all pixels, in all batches since the engine opened.
    pub samples: u64,
}
