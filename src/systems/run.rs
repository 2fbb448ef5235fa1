//! How a system is put into the schedule: counted each time it is entered, its error kept.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;

use super::error::{EngineError, Fault};

/// How often each system was entered since the engine opened: one that has nothing to do is not.
#[derive(Resource, Default)]
pub struct Entered(pub BTreeMap<&'static str, u64>);

/// What a system returns.
pub trait Outcome {
    fn error(self) -> Option<EngineError>;
}

impl Outcome for () {
    fn error(self) -> Option<EngineError> {
        None
    }
}

impl Outcome for Result<(), EngineError> {
    fn error(self) -> Option<EngineError> {
        self.err()
    }
}

/// To be piped behind a system: counts it under a name, and keeps its error if it is the first of this run.
pub fn counted<T: Outcome + 'static>(name: &'static str) -> impl FnMut(In<T>, ResMut<Fault>, ResMut<Entered>) {
    move |In(outcome), mut fault, mut entered| {
        *entered.0.entry(name).or_default() += 1;
        if let Some(error) = outcome.error()
            && fault.0.is_none()
        {
            fault.0 = Some(error);
        }
    }
}
