//! What a session starts from: a scene as it was read, or as it was edited until its device was lost.

use std::path::Path;

use winit::event_loop::EventLoopProxy;

use super::edits::Edits;
use super::family::Family;
use crate::app::shared::failure::show;
use crate::app::shared::scene::{Opened, SceneFlags};
use crate::engine::Engine;
use crate::scene::SceneDescription;
use crate::shader::Library;

/// What a session starts from.
pub struct Opening {
    pub description: SceneDescription,
    /// The scene as it was read, to be watched.
    pub(super) opened: Opened,
    pub(super) flags: SceneFlags,
    /// The scene was found by its name: which file that is, the user did not say.
    pub(super) is_found: bool,
    /// Those that the scene is a member of.
    pub(super) family: Option<Family>,
    /// The shaders to go on with.
    pub(super) shaders: Library,
    /// The panel is open at first.
    pub panel: bool,
    /// A device was lost.
    pub(super) again: bool,
    /// Edits are judged without being asked for it.
    pub(super) judges: bool,
    /// What was saved on a device that was lost.
    pub(super) edits: Option<Edits>,
    /// Wakes the window when something was saved.
    pub(super) wake: EventLoopProxy<()>,
}

impl Opening {
    /// A scene as it was read, and the shaders that draw it; with the panel.
    pub fn new(opened: Opened, shaders: Library, flags: SceneFlags, wake: EventLoopProxy<()>) -> Self {
        let description = opened.description.clone();
        let (is_found, panel, again, judges) = (false, true, false, true);
        Self { description, opened, flags, is_found, family: None, shaders, panel, again, judges, edits: None, wake }
    }

    /// The scene is the one that a user called so: by the path of its file, or by a name.
    pub fn called(self, name: &str) -> Self {
        Self { is_found: self.opened.path != Path::new(name), ..self }
    }

    /// A member of a family.
    pub fn of_family(self, family: Family) -> Self {
        Self { family: Some(family), ..self }
    }

    /// Whether edits are judged without being asked for it.
    pub fn judging(self, judges: bool) -> Self {
        Self { judges, ..self }
    }

    /// Watches the scene's files and the shaders. The window does without if that can't be done.
    pub(super) fn watch(&self, engine: &mut Engine, library: Library) {
        let wake = self.wake.clone();
        let sources = match &self.family {
            Some(family) => family.sources(self.opened.clone(), library),
            None => self.flags.sources(self.opened.clone(), library),
        };
        let woken = move || {
            // A window that has gone has nothing to wake for.
            let _ = wake.send_event(());
        };
        if let Err(error) = engine.watch(sources, woken) {
            show(&error);
        }
    }
}
