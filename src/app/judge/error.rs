//! Why nothing was judged.

use crate::engine::EngineError;
use crate::shader::ShaderError;

/// Why nothing was judged.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum JudgeError {
    #[error(transparent)]
    #[diagnostic(transparent)]
    Shader(#[from] ShaderError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Engine(#[from] EngineError),
    /// Of the shaders to judge by: no fault of those that are judged.
    #[error(transparent)]
    #[diagnostic(transparent)]
    OldShader(ShaderError),
    /// The same, found by the engine that runs them.
    #[error(transparent)]
    #[diagnostic(transparent)]
    OldEngine(EngineError),
    #[error("stopped before it was judged")]
    Stopped,
}

impl JudgeError {
    /// The same, of the shaders to judge by.
    pub fn of_old(self) -> Self {
        match self {
            Self::Shader(error) => Self::OldShader(error),
            Self::Engine(error) => Self::OldEngine(error),
            other => other,
        }
    }
}
