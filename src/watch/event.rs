//! What a reload tells: for a terminal, for the window, for an editor's tools.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use crate::gpu::GpuError;
use crate::scene::{self, Diagnostics, Severity};
use crate::shader::ShaderError;

/// Something that happened to what was saved.
#[derive(Clone, Debug)]
pub enum ReloadEvent {
    /// It is what the engine runs from now on.
    Reloaded {
        /// The files that are other ones now, in order; none where a reload was asked for and nothing had changed.
        files: Vec<PathBuf>,
        restarts: Restarts,
        /// What was not taken as written.
        warnings: Vec<Problem>,
        since_save: Duration,
    },
    /// The driver takes long to compile it: told again every few seconds. What runs goes on, and a later save takes its place.
    Compiling {
        files: Vec<PathBuf>,
        since: Duration,
        /// Older compiles that have not ended yet: a driver can't be told to stop.
        given_up: usize,
        /// What may be why.
        warnings: Vec<Problem>,
    },
    /// It can't be used: the engine goes on with the last that could.
    Failed { files: Vec<PathBuf>, problems: Vec<Problem>, since_save: Duration },
    /// The first samples, or the first picture, that came of it are there.
    FirstPixels { since_save: Duration },
    /// Other code of surfaces was asked whether sampling and evaluation agree. What is wrong is a warning: it runs all the same.
    Linted { warnings: Vec<Problem>, took: Duration },
}

/// What a reload makes start anew.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Restarts {
    pub tree: bool,
    pub film: bool,
    pub picture: bool,
}

impl Restarts {
    /// What either makes start anew.
    pub fn with(self, other: Restarts) -> Restarts {
        Restarts {
            tree: self.tree || other.tree,
            film: self.film || other.film,
            picture: self.picture || other.picture,
        }
    }
}

impl fmt::Display for Restarts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [(self.tree, "tree"), (self.film, "film"), (self.picture && !self.film, "picture")];
        let names: Vec<&str> = parts.iter().filter_map(|(on, name)| on.then_some(*name)).collect();
        f.write_str(&if names.is_empty() { "nothing".to_owned() } else { names.join(" and ") })
    }
}

/// One thing that is wrong with a saved file.
#[derive(Clone)]
pub struct Problem {
    /// The file, where one can be named.
    pub file: Option<String>,
    /// Line and column from 1, the column in characters; 0 where the message is about the whole file.
    pub line: usize,
    pub column: usize,
    pub message: String,
    /// With source line and help, for whoever shows it.
    pub diagnostic: Arc<dyn miette::Diagnostic + Send + Sync>,
}

impl Problem {
    /// One without a place.
    pub fn of(error: impl miette::Diagnostic + Send + Sync + 'static) -> Self {
        Problem { file: None, line: 0, column: 0, message: error.to_string(), diagnostic: Arc::new(error) }
    }
}

impl fmt::Debug for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.diagnostic)
    }
}

impl From<ShaderError> for Problem {
    fn from(error: ShaderError) -> Self {
        let (line, column) = error.line_column().unwrap_or_default();
        let file = error.file().map(str::to_owned);
        Problem { file, line, column, message: error.message.clone(), diagnostic: Arc::new(error) }
    }
}

impl From<scene::Diagnostic> for Problem {
    fn from(diagnostic: scene::Diagnostic) -> Self {
        Problem {
            file: Some(diagnostic.file.display().to_string()),
            line: diagnostic.line as usize,
            column: diagnostic.column as usize,
            message: diagnostic.message.clone(),
            diagnostic: Arc::new(diagnostic),
        }
    }
}

impl From<GpuError> for Problem {
    fn from(error: GpuError) -> Self {
        match error {
            GpuError::Shader(error) => (*error).into(),
            other => Problem::of(other),
        }
    }
}

/// The errors of a load; warnings beside them are left out.
pub fn problems_of(diagnostics: Diagnostics) -> Vec<Problem> {
    let errors = diagnostics.list.into_iter().filter(|one| one.severity == Severity::Error);
    errors.map(Problem::from).collect()
}
