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
    #[error("stopped before it was judged")]
    Stopped,
}
