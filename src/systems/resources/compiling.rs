//! Tells somebody when compiling begins and when it is over, so that a person who waits knows what for.

use std::sync::Arc;

use bevy_ecs::prelude::*;

/// Who is told: true when compiling begins, false when it is over. Called on the thread that compiles.
#[derive(Resource, Default, Clone)]
pub struct CompileListener(Option<Arc<dyn Fn(bool) + Send + Sync>>);

impl CompileListener {
    pub fn new(told: impl Fn(bool) + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(told)))
    }

    /// Says that compiling begins, and, when what is returned is dropped, that it is over.
    pub fn tell(&self) -> Telling {
        if let Some(told) = &self.0 {
            told(true);
        }
        Telling(self.clone())
    }
}

/// Compiling goes on while this lives.
pub struct Telling(CompileListener);

impl Drop for Telling {
    fn drop(&mut self) {
        if let Some(told) = &self.0.0 {
            told(false);
        }
    }
}
