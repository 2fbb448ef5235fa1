//! What a user did in the panel: gathered while it is drawn, followed by the session after that.

use super::edits::EditsAction;
use super::errors::ErrorsAction;
use crate::components::Lens;

/// What a user did in the panel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// A component was written, or another view chosen.
    pub edited: bool,
    /// Something that the picture follows by the hand, like a moving camera.
    pub moved: bool,
    /// A camera was chosen.
    pub camera: Option<String>,
    /// The lens as it is to be.
    pub lens: Option<Lens>,
    /// A member of the family was chosen.
    pub member: Option<String>,
    /// The scene's file is to have what was changed.
    pub save: bool,
    /// The brightest paths of the pixel are to be shown, or taken away.
    pub paths: bool,
    /// What there is to tell: something was copied.
    pub said: Option<String>,
    /// What is wanted of the record of edits.
    pub edits: Option<EditsAction>,
    /// What is wanted to know of the error.
    pub errors: Option<ErrorsAction>,
}

impl Outcome {
    /// Adds what was done in a later pass of the same frame.
    pub fn add(&mut self, later: Outcome) {
        self.edited |= later.edited;
        self.moved |= later.moved;
        self.camera = later.camera.or(self.camera.take());
        self.lens = later.lens.or(self.lens.take());
        self.member = later.member.or(self.member.take());
        self.save |= later.save;
        self.paths |= later.paths;
        self.said = later.said.or(self.said.take());
        self.edits = later.edits.or(self.edits);
        self.errors = later.errors.or(self.errors);
    }
}
