//! The picture of the member that was left last, beside that of the one that is shown.

use glam::UVec2;

use crate::gpu::Fit;

/// What a window showed of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seen {
    /// Of the scene.
    pub name: String,
    /// Pixels.
    pub size: UVec2,
    /// How it lay on the window.
    pub fit: Fit,
    /// sRGB, row by row from the top.
    pub pixels: Vec<[u8; 4]>,
}

/// The member before, and whether it is to be seen.
#[derive(Debug, Default)]
pub struct Pair {
    /// What was shown when something was saved, or another member chosen.
    last: Option<Seen>,
    before: Option<Seen>,
    /// It is wanted beside the film.
    pub on: bool,
}

impl Pair {
    /// Keeps what is shown before something else is.
    pub fn keep(&mut self, seen: Seen) {
        self.last = Some(seen);
    }

    /// Another scene may be shown now. Says whether it is.
    pub fn follow(&mut self, name: &str) -> bool {
        let left = self.last.take().filter(|last| last.name != name);
        let other = left.is_some();
        self.before = left.or(self.before.take());
        other
    }

    /// What lies beside the film of a scene, where that is wanted and there is anything.
    pub fn beside(&self, name: &str) -> Option<&Seen> {
        self.before.as_ref().filter(|before| self.on && before.name != name)
    }
}
