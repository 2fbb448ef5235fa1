//! The window's session judging the last edit: begin, show what was found, end.

use super::session::Session;
use crate::app::shared::output;

impl Session {
    /// Judges the last edit of the shaders, or ends that.
    pub(super) fn toggle_judging(&mut self) {
        if self.judgement.is_shown() {
            self.end_judging();
            self.notify("no longer judged".to_owned());
            self.resume();
            return;
        }
        let name = self.name().to_owned();
        let scene = self.engine.describe(&name);
        if !self.judgement.start(self.gpu.clone(), scene, self.wake()) {
            return self.notify("nothing to judge yet: no edit has changed what is traced".to_owned());
        }
        self.draw_again();
    }

    /// Shows what judging has found; says the verdict in the terminal too.
    pub(super) fn show_judgement(&mut self) {
        if !self.judgement.receive() {
            return;
        }
        if let Some(verdict) = self.judgement.line().filter(|_| !self.judgement.is_under_way()) {
            output::note(verdict);
        }
        self.overlay.show_split(self.judgement.picture());
        self.draw_again();
    }

    /// What is judged is the scene as it was: judging ends when that changes.
    pub(super) fn end_judging(&mut self) {
        if self.judgement.end() {
            self.overlay.show_split(None);
        }
    }

    /// Shows the pictures of before and after side by side, or ends that.
    pub(super) fn toggle_split(&mut self) {
        if self.family().is_some() && !self.judgement.is_shown() {
            return self.toggle_pair();
        }
        self.judgement.split = !self.judgement.split;
        let shown = self.judgement.picture();
        if self.judgement.split && shown.is_none() {
            self.notify("before and after, once judged (J)".to_owned());
        }
        self.overlay.show_split(shown);
        self.draw_again();
    }

    /// Remembers the shaders from before an edit; `traces` is whether that changed what is traced.
    pub(super) fn follow_shaders(&mut self, traces: bool) {
        self.judgement.follow(self.engine.library(), traces);
    }
}
