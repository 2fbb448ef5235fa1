//! What rows measure on.

use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use super::measured::{Scale, StressError};
use super::tools::edits::Kind;
use crate::engine::{Engine, EngineError, FilmImage};
use crate::gpu::{Gpu, Runtime};
use crate::scene::SceneDescription;
use crate::shader::Library;

/// Between two words about how far a film is.
const STEP: Duration = Duration::from_millis(200);

/// A device, the shaders that are measured, and how much is measured with them.
pub struct Lab {
    gpu: Arc<Gpu>,
    library: Library,
    scale: Scale,
    /// Where random edits begin, and for how long they are made; as the row has it, if not said.
    seed: u64,
    seconds: Option<f64>,
    /// Edits that the engine is not to see: a mistake.
    unseen: Option<Kind>,
    /// Told the part of a row that is done, 0 to 1.
    progress: Box<dyn Fn(f64) + Send + Sync>,
}

impl fmt::Debug for Lab {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "Lab on {}, {:?}", self.gpu.name(), self.scale)
    }
}

impl Lab {
    /// With the shaders that are shipped.
    pub fn new(gpu: Arc<Gpu>, scale: Scale) -> Self {
        let (library, progress) = (Library::shipped(), Box::new(|_| ()));
        Self { gpu, library, scale, seed: 1, seconds: None, unseen: None, progress }
    }

    /// The same with other shaders.
    pub fn with_library(self, library: Library) -> Self {
        Self { library, ..self }
    }

    /// The same, whose random edits begin with another seed, and are made for so many seconds.
    pub fn with_edits(self, seed: u64, seconds: Option<f64>) -> Self {
        Self { seed, seconds, ..self }
    }

    /// The same, whose engine does not see edits of a kind.
    pub fn with_unseen(self, unseen: Option<Kind>) -> Self {
        Self { unseen, ..self }
    }

    /// The same, which tells how far a row is.
    pub fn with_progress(self, progress: impl Fn(f64) + Send + Sync + 'static) -> Self {
        Self { progress: Box::new(progress), ..self }
    }

    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// The shaders that are measured.
    pub fn library(&self) -> &Library {
        &self.library
    }

    pub fn scale(&self) -> Scale {
        self.scale
    }

    /// The seed that random edits begin with.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// For how long random edits are made, where that was said.
    pub fn seconds(&self) -> Option<f64> {
        self.seconds
    }

    /// Edits that the engine is not to see.
    pub fn unseen(&self) -> Option<Kind> {
        self.unseen
    }

    /// Says that this part of a row is done.
    pub fn tell(&self, done: u64, of: u64) {
        (self.progress)(done as f64 / of.max(1) as f64);
    }

    /// A device without a scene.
    pub fn rig(&self) -> Runtime {
        Runtime::new(self.gpu.clone(), self.library.clone())
    }

    pub fn engine(&self, description: &SceneDescription) -> Result<Engine, EngineError> {
        Engine::open(self.gpu.clone(), self.library.clone(), description)
    }

    /// The film of a scene with all its samples.
    pub fn film(&self, description: &SceneDescription) -> Result<FilmImage, StressError> {
        finish(&mut self.engine(description)?)
    }

    /// Whether the device is the processor.
    pub fn is_software(&self) -> bool {
        self.gpu.is_software()
    }
}

/// The film of an engine's scene with all its samples; none of them may be bad.
pub fn finish(engine: &mut Engine) -> Result<FilmImage, StressError> {
    while !engine.step(STEP)?.finished {}
    let bad = engine.report()?.bad_samples;
    match bad {
        0 => Ok(engine.film()?),
        _ => Err(StressError::Broken(format!("{bad} bad samples"))),
    }
}
