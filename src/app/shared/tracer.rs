//! An open scene whose film is traced again and again: with other settings, and to some number of samples.

use std::sync::Arc;
use std::time::Duration;

use super::compiling::watch_compiling;
use super::interrupt::Interrupt;
use super::progress::Meter;
use crate::components::{Film, Render};
use crate::engine::{Engine, EngineError, FilmImage, Progress, Report};
use crate::gpu::Gpu;
use crate::scene::SceneDescription;
use crate::shader::{Features, Library};

/// Tracing between two polls of signals: as long as that of a headless render.
pub const STEP: Duration = Duration::from_millis(100);

/// Shows how far all is, and listens for signals.
pub struct Monitor {
    pub meter: Meter,
    pub interrupt: Interrupt,
}

/// One scene on the device.
pub struct Tracer {
    engine: Engine,
    /// The settings of the scene.
    pub render: Render,
}

impl Tracer {
    /// Opens a scene. Nothing is traced yet.
    pub fn open(gpu: &Arc<Gpu>, library: &Library, description: &SceneDescription) -> Result<Self, EngineError> {
        let engine = Engine::open(gpu.clone(), library.clone(), description)?;
        Ok(Self { engine, render: description.render })
    }

    /// Has a meter show how long shaders are compiled, where a step has to wait for that.
    pub fn show_compiling(&mut self, meter: &Meter) {
        self.engine.on_compiling(watch_compiling(meter.show_compiling()));
    }

    /// Changes the settings, number of samples included: where they are others than before, the film starts anew.
    pub fn set(&mut self, render: Render) {
        self.engine.edit(|world| {
            for mut held in world.query::<&mut Render>().iter_mut(world) {
                *held = render;
            }
        });
    }

    /// Has the kernels compiled with all that can be idle in them.
    pub fn set_general(&mut self, on: bool) {
        self.engine.set_general(on);
    }

    /// Changes the film: where it is another than before, it starts anew.
    pub fn set_film(&mut self, film: Film) {
        self.engine.edit(|world| {
            for mut held in world.query::<&mut Film>().iter_mut(world) {
                *held = film;
            }
        });
    }

    /// Traces for about a tenth of a second.
    pub fn step(&mut self) -> Result<Progress, EngineError> {
        self.step_for(STEP)
    }

    /// Traces for about some time.
    pub fn step_for(&mut self, time: Duration) -> Result<Progress, EngineError> {
        self.engine.step(time)
    }

    /// Traces until the film is finished. False if a signal came before that.
    pub fn finish(&mut self, monitor: &mut Monitor) -> Result<bool, EngineError> {
        loop {
            let step = self.step()?;
            monitor.meter.advance(step.samples, step.spp);
            match (step.finished, monitor.interrupt.requested()) {
                (true, _) => return Ok(true),
                (false, true) => return Ok(false),
                (false, false) => {}
            }
        }
    }

    /// Reads the film back.
    pub fn film(&mut self) -> Result<FilmImage, EngineError> {
        self.engine.film()
    }

    /// Reads the film's mean radiance back, and nothing else of it.
    pub fn radiance(&mut self) -> Result<Vec<[f32; 3]>, EngineError> {
        self.engine.radiance()
    }

    /// Shader features of the scene, as the last step found them.
    pub fn features(&mut self) -> Features {
        self.engine.features().clone()
    }

    /// What was done since the scene was opened.
    pub fn report(&mut self) -> Result<Report, EngineError> {
        self.engine.report()
    }
}
