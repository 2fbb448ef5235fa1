//! The window's session judging the last edit: begin, show what was found, end.

use super::judging::Judging;
use super::session::Session;
use crate::app::output;

impl Session {
    /// Judges the last edit of the shaders, or ends that.
    pub(super) fn toggle_judging(&mut self) {
        if self.judging.is_some() {
            self.end_judging();
            self.notify("no longer judged".to_owned());
            self.look_again();
            return;
        }
        let Some(old) = self.old_shaders.clone() else {
            return self.notify("nothing to judge yet: no edit has changed what is traced".to_owned());
        };
        let name = self.name().to_owned();
        let scene = self.engine.describe(&name);
        let sides = [old, self.shaders.clone()];
        self.judging = Some(Judging::start(self.gpu.clone(), sides, scene, self.wake()));
        self.draw_again();
    }

    /// Takes up what judging has found; says the verdict in the terminal too.
    pub(super) fn take_judgement(&mut self) {
        let Some(judging) = &mut self.judging else { return };
        if !judging.take() {
            return;
        }
        if !judging.is_under_way() {
            output::note(&judging.line);
        }
        let shown = judging.split.clone().filter(|_| self.split);
        self.overlay.show_split(shown);
        self.draw_again();
    }

    /// What is judged is the scene as it was: judging ends when that changes.
    pub(super) fn end_judging(&mut self) {
        if let Some(judging) = self.judging.take() {
            self.ending.wait_for(judging.end());
            self.overlay.show_split(None);
        }
    }

    /// Shows the pictures of before and after side by side, or ends that.
    pub(super) fn toggle_split(&mut self) {
        self.split = !self.split;
        let shown = self.judging.as_ref().and_then(|judging| judging.split.clone()).filter(|_| self.split);
        if self.split && shown.is_none() {
            self.notify("before and after, once judged (J)".to_owned());
        }
        self.overlay.show_split(shown);
        self.draw_again();
    }

    /// Remembers the shaders from before an edit that changed what is traced.
    pub(super) fn take_shaders(&mut self, traces: bool) {
        let now = self.engine.library();
        // What was taken back is not there to be judged.
        self.old_shaders = self.old_shaders.take().filter(|old| !old.is_same(&now));
        if traces && !now.is_same(&self.shaders) {
            self.old_shaders = Some(std::mem::replace(&mut self.shaders, now));
        } else {
            self.shaders = now;
        }
    }
}
