//! What failed when it was last tried, and why.

use std::collections::BTreeMap;

use crate::app::Failure;
use crate::app::shared::failure::rendered;
use crate::engine::EngineError;
use crate::gpu::GpuError;

/// Texts of errors by what was tried. Each stands until the same succeeds.
#[derive(Default)]
pub struct Failures(BTreeMap<&'static str, String>);

impl Failures {
    /// Goes on after an error, unless the device is lost: it is said once in the terminal, and stands from now on.
    pub fn survive<T>(&mut self, what: &'static str, result: Result<T, EngineError>) -> Result<Option<T>, EngineError> {
        match result {
            Ok(done) => {
                self.0.remove(what);
                Ok(Some(done))
            }
            Err(EngineError::Gpu(error @ GpuError::Lost { .. })) => Err(error.into()),
            Err(error) => {
                let failure = Failure::engine(error);
                let text = rendered(&*failure.report, false);
                if self.0.get(what) != Some(&text) {
                    failure.show();
                }
                self.0.insert(what, text);
                Ok(None)
            }
        }
    }

    /// Those that stand.
    pub fn texts(&self) -> impl Iterator<Item = &String> {
        self.0.values()
    }
}
