//! What can go wrong on a device, and what to do about it.

use super::room::advice;
use crate::shader::ShaderError;

/// A failure of the device or of what was asked of it.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum GpuError {
    #[error("no graphics adapter was found")]
    #[diagnostic(help(
        "install a Vulkan driver: `sh setup.sh` does so on Debian and Ubuntu; elsewhere install your GPU vendor's \
         driver, or Mesa's software driver (lavapipe). Windows needs DirectX 12, macOS needs nothing. \
         `lucerna doctor` lists what is found"
    ))]
    NoAdapter,

    #[error("{variable} is `{asked}`, which is no adapter's number")]
    #[diagnostic(help("the adapters are {known}; without {variable}, the first is taken"))]
    NoSuchAdapter { variable: &'static str, asked: String, known: String },

    #[error("{variable} is `{asked}`, which is no number of bytes that a buffer could have at most")]
    #[diagnostic(help(
        "give bytes, at least {least}; without {variable}, buffers are as large as the adapter lets them"
    ))]
    NoSuchBuffer { variable: &'static str, asked: String, least: u64 },

    #[error("no adapter can show pictures on this display")]
    #[diagnostic(help("`lucerna render` draws without a display; `lucerna doctor` lists the adapters"))]
    NoPresenter,

    #[error("{adapter} cannot show pictures on this display")]
    #[diagnostic(help("choose another by LUCERNA_ADAPTER (`lucerna doctor` lists them), or use `lucerna render`"))]
    CannotPresent { adapter: String },

    #[error("the window cannot be drawn on: {reason}")]
    #[diagnostic(help("`lucerna render` draws without a display"))]
    NoSurface { reason: String },

    #[error("{adapter} refused a device: {reason}")]
    Device { adapter: String, reason: String },

    #[error("the buffer `{name}` needs {need} bytes, more than {limit} bytes, the limit of {adapter} for {what}")]
    #[diagnostic(help("{}", advice(name, *limit)))]
    TooLarge { name: &'static str, need: u64, limit: u64, adapter: String, what: &'static str },

    #[error("the device ran out of memory on {what}")]
    #[diagnostic(help("{smaller}, or close what else uses the GPU"))]
    OutOfMemory { what: String, smaller: &'static str },

    #[error("the device was lost: {reason}")]
    #[diagnostic(help(
        "the driver stopped, often because one dispatch took too long; run again, and see the system's log"
    ))]
    Lost { reason: String },

    #[error("{what}: {reason}")]
    Validation { what: String, reason: String },

    #[error(transparent)]
    #[diagnostic(transparent)]
    Shader(#[from] Box<ShaderError>),

    #[error("pass `{pass}` has no buffer named `{buffer}`")]
    NoBuffer { pass: &'static str, buffer: &'static str },
}

impl From<ShaderError> for GpuError {
    fn from(error: ShaderError) -> Self {
        GpuError::Shader(Box::new(error))
    }
}
