//! What the phases hand to each other: resources that live as long as the engine.

use std::collections::{BTreeSet, HashMap};
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::DVec3;

use super::EngineError;
use crate::components::EnvironmentMap;
use crate::gpu::{Gpu, Runtime};
use crate::layout::light::{LightRecord, LightTable};
use crate::layout::sky::SkyTable;
use crate::layout::trace::{MaterialRecord, Shading, TraceParams};
use crate::layout::tree::Triangle;
use crate::layout::view::ViewMode;
use crate::passes::Recording;

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

/// The first error of a run of the schedule. Later phases do nothing while there is one.
#[derive(Resource, Default)]
pub struct Fault(pub Option<EngineError>);

/// Keeps the error of a system, if it is the first.
pub fn keep_fault(In(result): In<Result<(), EngineError>>, mut fault: ResMut<Fault>) {
    if let Err(error) = result
        && fault.0.is_none()
    {
        fault.0 = Some(error);
    }
}

/// Run condition: nothing has gone wrong in this run of the schedule.
pub fn no_fault(fault: Res<Fault>) -> bool {
    fault.0.is_none()
}

/// The scene as the GPU holds it, by index.
#[derive(Resource, Default)]
pub struct PackedScene {
    /// Triangles and records are those that the device was sent; if not, all of them are to be sent again.
    pub sent: bool,
    /// The same of the lights.
    pub lights_sent: bool,
    /// The same of the sky.
    pub sky_sent: bool,
    /// World space point that is zero on the GPU.
    pub origin: DVec3,
    /// Triangles of all meshes, in the order of the meshes' names.
    pub triangles: u32,
    /// Some mesh has normals of its own.
    pub normals: bool,
    /// Meshes in the order of their names.
    pub meshes: Vec<Entity>,
    /// Materials in the order of their names; the last record, which has no entity, is the default one.
    pub materials: Vec<Entity>,
    pub material_index: HashMap<Entity, u32>,
    pub records: Vec<MaterialRecord>,
    /// World space box of all meshes, scene units; low above high without any.
    pub low: DVec3,
    pub high: DVec3,
    /// Emitting triangles, where lights are asked directly; else none.
    pub lights: LightTable,
    /// The picture of the environment, with its strength, that the device has; and what came of it.
    pub sky: Option<Sky>,
    /// What the camera, the film, the settings and the environment come to, but for the batch.
    pub shot: TraceParams,
    /// Radiance is summed in units of 2^-exponent.
    pub exponent: i32,
    /// Shader features that the scene needs.
    pub features: BTreeSet<String>,
    /// Stops by which the picture is brightened.
    pub exposure: f32,
    /// Samples a pixel to reach.
    pub target: u32,
}

impl PackedScene {
    /// Has everything sent again.
    pub fn send_again(&mut self) {
        (self.sent, self.lights_sent, self.sky_sent) = (false, false, false);
    }
}

/// An environment as it was last packed.
#[derive(Clone, Debug)]
pub struct Sky {
    pub image: std::sync::Arc<EnvironmentMap>,
    pub strength: f32,
    /// Pixels.
    pub size: glam::UVec2,
    /// Integral of the luminance over the sphere.
    pub power: f64,
    /// The largest channel of any pixel.
    pub brightest: f32,
}

/// Arrays on their way to the GPU.
#[derive(Resource, Default)]
pub struct Pending {
    /// Runs of triangles by the index of their first.
    pub triangles: Vec<(u32, Vec<Triangle>)>,
    /// Runs of corner normals by the index of their first triangle.
    pub shading: Vec<(u32, Vec<Shading>)>,
    /// Runs of material records by the index of their first.
    pub materials: Vec<(u32, Vec<MaterialRecord>)>,
    /// All emitting triangles.
    pub lights: Option<Vec<LightRecord>>,
    pub sky: Option<SkyTable>,
}

/// What this run of the schedule has to do again.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dirty {
    /// Triangles changed: Morton codes to tree.
    pub tree: bool,
    /// Light changed: the film starts anew.
    pub film: bool,
    /// The picture is shown otherwise.
    pub picture: bool,
}

/// How far the film has come.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct FilmProgress {
    /// Samples that every pixel of the window has.
    pub samples: u32,
    /// Rows, from the top, that have one more.
    pub rows: u32,
    /// The film's words were set to zero since it was reset.
    pub cleared: bool,
    /// What the picture shows of this very film and scene; none while it shows what was before.
    pub shown: Option<ViewMode>,
}

impl FilmProgress {
    /// The picture of the film, if it is that which is shown, is an older one from now on.
    pub fn outdate_beauty(&mut self) {
        self.shown = self.shown.filter(|mode| *mode != ViewMode::Beauty);
    }
}

/// The samples this run of the schedule adds.
#[derive(Resource, Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Batch {
    pub first_sample: u32,
    /// Samples a pixel; more than one only with all rows.
    pub layers: u32,
    pub first_row: u32,
    pub rows: u32,
}

impl Batch {
    /// Samples of the batch, over all its pixels.
    pub fn samples(&self, width: u32) -> u64 {
        u64::from(self.layers) * u64::from(self.rows) * u64::from(width)
    }
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

/// Somebody watches: the picture follows the film batch by batch.
#[derive(Resource, Default)]
pub struct Live(pub bool);

/// What the picture is to show.
#[derive(Resource, Default)]
pub struct Viewed(pub ViewMode);

/// Time this run of the schedule may take on the GPU.
#[derive(Resource)]
pub struct Budget(pub Duration);

/// Seconds spent so far.
#[derive(Resource, Default, Clone, Copy, Debug)]
pub struct Spent {
    pub build: f64,
    pub trace: f64,
    /// Samples over all pixels, in all batches since the engine opened.
    pub samples: u64,
}

/// Where a mesh's triangles are on the GPU, and what they were made from: by comparing with these, an edit that
/// changes nothing does nothing.
#[derive(Component, Clone, Debug)]
pub struct MeshSlot {
    /// Index of its first triangle.
    pub first: u32,
    pub count: u32,
    /// World space corners, scene units; empty meshes have low above high.
    pub low: DVec3,
    pub high: DVec3,
    pub geometry: std::sync::Arc<crate::components::MeshData>,
    pub transform: crate::components::Transform,
    pub material: u32,
}
