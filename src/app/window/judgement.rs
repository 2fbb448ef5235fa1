//! The edit that is judged: asked for by a key, or by itself while nothing else needs the device; and what was found so far.

use glam::UVec2;

use super::alike::{is_alike, looks_alike};
use super::edits::record::RowId;
use super::judging::{Ending, Judging, Place};
use crate::app::edits::Verdict;
use crate::scene::SceneDescription;
use crate::shader::Library;

/// What is judged, if anything is.
#[derive(Default)]
pub struct Judgement {
    current: Option<Current>,
    ending: Ending,
    /// Before and after are shown side by side, where they were judged.
    pub split: bool,
}

/// A row that is judged, or was, and nothing that is seen changed since.
struct Current {
    of: RowId,
    judging: Judging,
    /// As it was when that began.
    scene: SceneDescription,
    /// A user asked for it, and has it over the picture.
    asked: bool,
    paused: bool,
}

impl Judgement {
    /// The row that is judged, or was.
    pub fn of(&self) -> Option<RowId> {
        self.current.as_ref().map(|current| current.of)
    }

    /// Whether a user asked for it, and nothing changed since.
    pub fn is_shown(&self) -> bool {
        self.current.as_ref().is_some_and(|current| current.asked)
    }

    /// Whether more is to be found.
    pub fn is_under_way(&self) -> bool {
        self.current.as_ref().is_some_and(|current| current.judging.is_under_way())
    }

    /// Whether it traces now: the film rests then, for times are compared.
    pub fn has_device(&self) -> bool {
        self.is_under_way() && !self.is_paused()
    }

    /// Whether it waits for the device.
    pub fn is_paused(&self) -> bool {
        self.current.as_ref().is_some_and(|current| current.paused && current.judging.is_under_way())
    }

    /// What was found so far, in a line, where a user asked for it.
    pub fn line(&self) -> Option<&str> {
        self.current.as_ref().filter(|current| current.asked).map(|current| current.judging.line.as_str())
    }

    /// Before and after side by side, where that is wanted and there is anything.
    pub fn picture(&self) -> Option<(UVec2, Vec<[u8; 4]>)> {
        let current = self.current.as_ref().filter(|_| self.split && !self.is_paused());
        current.and_then(|current| current.judging.split.clone())
    }

    /// Has a row judged, by the shaders before it and its own, in place of any other.
    pub fn start(&mut self, of: RowId, sides: [Library; 2], place: Place, asked: bool) {
        self.end();
        let scene = place.scene.clone();
        let judging = Judging::start(sides, place);
        self.current = Some(Current { of, judging, scene, asked, paused: false });
    }

    /// A user asks for what is judged by itself. False where that is another row, or none, or what is seen is no longer what it was judged on.
    pub fn ask(&mut self, of: RowId, scene: &SceneDescription) -> bool {
        let is_asked = |current: &&mut Current| current.of == of && looks_alike(&current.scene, scene);
        let Some(current) = self.current.as_mut().filter(is_asked) else { return false };
        current.asked = true;
        self.rest(false);
        true
    }

    /// Lets judging wait for the device, or go on.
    pub fn rest(&mut self, on: bool) {
        if let Some(current) = &mut self.current {
            current.paused = on;
            current.judging.rest(on);
        }
    }

    /// What is seen is about to change: what is over is put away, and what is under way waits, or ends where it may not go on `later`.
    pub fn step_aside(&mut self, later: bool) {
        if !later || !self.is_under_way() {
            self.end();
        } else if let Some(current) = &mut self.current {
            current.asked = false;
            self.rest(true);
        }
    }

    /// Receives what was found since the last call: of which row, and what.
    pub fn receive(&mut self) -> Option<(RowId, Verdict)> {
        let current = self.current.as_mut()?;
        let verdict = current.judging.receive().then(|| current.judging.verdict.clone())?;
        Some((current.of, verdict))
    }

    /// Ends judging. Says whether there was any.
    pub fn end(&mut self) -> bool {
        let Some(current) = self.current.take() else { return false };
        self.ending.wait_for(current.judging.end());
        true
    }

    /// Whether a row is judged on a scene, wherever that is looked at from: films by one camera are as good as by another.
    pub fn is_on(&self, of: RowId, scene: &SceneDescription) -> bool {
        self.current.as_ref().is_some_and(|current| current.of == of && is_alike(&current.scene, scene))
    }
}
