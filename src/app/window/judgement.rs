//! The last edit of the shaders: what it replaced, and what judging it has found so far.

use std::sync::Arc;

use glam::UVec2;
use winit::event_loop::EventLoopProxy;

use super::judging::{Ending, Judging};
use crate::gpu::Gpu;
use crate::scene::SceneDescription;
use crate::shader::Library;

/// The shaders before and after an edit, and the judging of it.
pub struct Judgement {
    /// The shaders that are run.
    shaders: Library,
    /// Those from before the last edit that changed what is traced.
    old: Option<Library>,
    judging: Option<Judging>,
    ending: Ending,
    /// Before and after are shown side by side, where they were judged.
    pub split: bool,
}

impl Judgement {
    /// Nothing is edited yet.
    pub fn new(shaders: Library) -> Self {
        Self { shaders, old: None, judging: None, ending: Ending::default(), split: false }
    }

    /// Whether an edit is judged, or was, and nothing changed since.
    pub fn is_shown(&self) -> bool {
        self.judging.is_some()
    }

    /// Whether more is to be found.
    pub fn is_under_way(&self) -> bool {
        self.judging.as_ref().is_some_and(Judging::is_under_way)
    }

    /// What was found so far, in a line.
    pub fn line(&self) -> Option<&str> {
        self.judging.as_ref().map(|judging| judging.line.as_str())
    }

    /// Before and after side by side, where that is wanted and there is anything.
    pub fn picture(&self) -> Option<(UVec2, Vec<[u8; 4]>)> {
        self.judging.as_ref().and_then(|judging| judging.split.clone()).filter(|_| self.split)
    }

    /// Has the last edit judged on a scene. False if there was none.
    pub fn start(&mut self, gpu: Arc<Gpu>, scene: SceneDescription, wake: EventLoopProxy<()>) -> bool {
        let Some(old) = self.old.clone() else { return false };
        self.judging = Some(Judging::start(gpu, [old, self.shaders.clone()], scene, wake));
        true
    }

    /// Receives what was found since the last call. Says whether there was anything.
    pub fn receive(&mut self) -> bool {
        self.judging.as_mut().is_some_and(Judging::receive)
    }

    /// Ends judging. Says whether there was any.
    pub fn end(&mut self) -> bool {
        let Some(judging) = self.judging.take() else { return false };
        self.ending.wait_for(judging.end());
        true
    }

    /// Remembers the shaders from before an edit; `traces` is whether that changed what is traced.
    pub fn follow(&mut self, now: Library, traces: bool) {
        // An edit that was undone is not there to be judged.
        self.old = self.old.take().filter(|old| !old.is_same(&now));
        let before = std::mem::replace(&mut self.shaders, now);
        if traces && !self.shaders.is_same(&before) {
            self.old = Some(before);
        }
    }
}
