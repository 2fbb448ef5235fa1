//! One estimator: an engine of its own, that traces a film whenever one is wanted.

use std::sync::Arc;
use std::time::Duration;

use super::clock::Clock;
use super::error::JudgeError;
use crate::app::shared::tracer::Tracer;
use crate::components::{Film, Render};
use crate::engine::EngineError;
use crate::gpu::Gpu;
use crate::scene::SceneDescription;
use crate::shader::{Features, Library};

pub struct Side {
    tracer: Tracer,
    /// Tracing between two looks at the clock.
    batch: Duration,
    /// Samples that were no numbers, over all films.
    pub bad_samples: u64,
}

/// Mean radiance of a film's pixels, and what it took.
pub struct Shot {
    pub radiance: Vec<[f32; 3]>,
    /// Of its batches, from submission to end.
    pub seconds: f64,
}

impl Side {
    /// Opens a scene. Nothing is compiled yet.
    pub fn open(
        gpu: &Arc<Gpu>,
        library: &Library,
        description: &SceneDescription,
        batch: Duration,
    ) -> Result<Self, EngineError> {
        Ok(Self { tracer: Tracer::open(gpu, library, description)?, batch, bad_samples: 0 })
    }

    /// Traces a film from its first sample to its last; `None` if the time is over before that.
    pub fn film(&mut self, film: Film, seed: u32, spp: u32, clock: &Clock) -> Result<Option<Shot>, JudgeError> {
        let before = self.tracer.report()?.seconds_trace;
        self.tracer.set(Render { seed, spp, ..self.tracer.render });
        self.tracer.set_film(film);
        loop {
            // Before the first step too: of films that one step finishes, there may be any number.
            if clock.is_over()? {
                return Ok(None);
            }
            if self.tracer.step_for(self.batch)?.finished {
                break;
            }
        }
        let report = self.tracer.report()?;
        self.bad_samples += report.bad_samples;
        Ok(Some(Shot { radiance: self.tracer.radiance()?, seconds: report.seconds_trace - before }))
    }

    /// Shader features of the scene, once a film was traced.
    pub fn features(&mut self) -> Features {
        self.tracer.features()
    }
}
