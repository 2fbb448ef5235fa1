//! What can go wrong in a run of the schedule.

use bevy_ecs::prelude::*;

use crate::gpu::GpuError;

/// Why a step failed. The engine goes on: the next step tries again, with a film that starts anew.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum EngineError {
    #[error(transparent)]
    #[diagnostic(transparent)]
    Gpu(#[from] GpuError),

    #[error("the scene has no camera")]
    #[diagnostic(help("add one under `cameras` in the scene file"))]
    NoCamera,

    #[error("the scene has no film")]
    NoFilm,

    #[error("the scene has more than one film")]
    #[diagnostic(help("an engine renders one film: despawn the others"))]
    ManyFilms,

    #[error("the film's window is empty, or outside the film")]
    #[diagnostic(help("a crop is X0,X1,Y0,Y1 in pixels, with X0 < X1 and Y0 < Y1 within the size"))]
    EmptyFilm,

    #[error("the scene has {count} triangles; {most} are the most")]
    #[diagnostic(help("use a coarser model"))]
    TooManyTriangles { count: u64, most: u32 },
}

/// The first error of a run of the schedule. Later phases do nothing while there is one.
#[derive(Resource, Default)]
pub struct Fault(pub Option<EngineError>);

/// Run condition: nothing has gone wrong in this run of the schedule.
pub fn no_fault(fault: Res<Fault>) -> bool {
    fault.0.is_none()
}
