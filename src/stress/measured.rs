//! What came of a measurement, and how much is measured.

use crate::engine::EngineError;
use crate::gpu::GpuError;
use crate::oracle::OracleError;
use crate::stats::agreement::is_beaten;

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// What `cargo test` has time for.
    Test,
    /// What two cores without a GPU do in a minute or so.
    Quick,
    /// What it takes to be sure; on a GPU.
    Full,
}

/// What came of a measurement.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// In the row's quantity.
    pub value: f64,
    /// Samples behind it.
    pub samples: u64,
    /// The case that it is of, or what else is worth a word; may be empty.
    pub note: String,
    /// Why it proves nothing here, if so.
    pub doubt: Option<String>,
}

impl Measured {
    pub fn new(value: f64, samples: u64) -> Self {
        Self { value, samples, note: String::new(), doubt: None }
    }

    /// The same with a word about it.
    pub fn noted(self, note: impl Into<String>) -> Self {
        Self { note: note.into(), ..self }
    }

    /// Taken together with another: the greater value with its note (NaN is the greatest), and all samples.
    pub fn worst(self, other: Self) -> Self {
        let samples = self.samples + other.samples;
        // Of equal ones the later: nothing, which a sum begins with, has no note.
        let beaten = is_beaten(self.value, other.value) || self.value == other.value;
        let (worse, better) = if beaten { (other, self) } else { (self, other) };
        let doubt = worse.doubt.clone().or(better.doubt);
        Self { samples, doubt, ..worse }
    }

    /// Taken together with another: the sum of counts, with the note of the first that is not 0.
    pub fn plus(self, other: Self) -> Self {
        let note = match (self.value == 0.0, other.value == 0.0) {
            (false, _) => self.note,
            (true, false) => other.note,
            // No case is worth a word.
            (true, true) => String::new(),
        };
        let (value, samples) = (self.value + other.value, self.samples + other.samples);
        Self { value, samples, note, doubt: self.doubt.or(other.doubt) }
    }
}

/// Why there is no figure.
#[derive(Debug, thiserror::Error)]
pub enum StressError {
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error("the f64 path tracer: {0}")]
    Oracle(#[from] OracleError),
    /// What is measured is broken in a way that has no figure.
    #[error("{0}")]
    Broken(String),
}

impl StressError {
    /// Whether it is the machine's fault rather than that of what is measured.
    pub fn is_of_machine(&self) -> bool {
        let of_gpu = |error: &GpuError| !matches!(error, GpuError::Shader(_) | GpuError::Validation { .. });
        match self {
            Self::Gpu(error) | Self::Engine(EngineError::Gpu(error)) => of_gpu(error),
            Self::Engine(_) | Self::Oracle(_) | Self::Broken(_) => false,
        }
    }
}
