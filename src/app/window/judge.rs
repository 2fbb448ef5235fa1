//! The window's session judging an edit that a user asks for: begin, show what was found, end.

use super::judging::Place;
use super::pace;
use super::session::Session;
use crate::app::edits::State;
use crate::app::judge::SECONDS;
use crate::app::shared::output;

impl Session {
    /// Judges the edit that runs, or ends that.
    pub(super) fn toggle_judging(&mut self) {
        if self.judgement.is_shown() {
            self.decline_judging();
            self.end_judging();
            self.notify("no longer judged".to_owned());
            self.resume();
            return;
        }
        let Some((of, sides)) = self.edits.record.last_traced() else {
            return self.notify("nothing to judge yet: no edit has changed what is traced".to_owned());
        };
        let place = self.judging_place(SECONDS);
        if !self.judgement.ask(of, &place.scene) {
            self.judgement.start(of, sides, place, true);
        }
        self.overlay.show_split(self.judgement.picture());
        self.draw_again();
    }

    /// Where an edit is judged: on the scene as it is now, in batches that no hand feels.
    pub(super) fn judging_place(&mut self, seconds: f64) -> Place {
        let name = self.name().to_owned();
        let batch = if self.gpu.is_software() { pace::MOVING_STEP } else { pace::STEP };
        let mut scene = self.engine.describe(&name);
        // The engine's camera follows the view in the next frame.
        scene.cameras.insert(scene.active.clone(), self.viewpoint.camera);
        Place { gpu: self.gpu.clone(), scene, batch, seconds, wake: self.wake() }
    }

    /// Takes what judging has found to its row, and shows it; says the verdict in the terminal too.
    pub(super) fn show_judgement(&mut self) {
        let Some((of, verdict)) = self.judgement.receive() else { return };
        let (state, line) = (verdict.state, verdict.line.clone());
        self.record_verdict(of, verdict);
        if state != State::Judging {
            output::note(&line);
        }
        if self.judgement.is_shown() || state != State::Judging {
            self.overlay.show_split(self.judgement.picture());
        }
        if self.judgement.is_shown() || self.panel.open || state != State::Judging {
            self.draw_again();
        }
    }

    /// Ends judging for good.
    pub(super) fn end_judging(&mut self) {
        if self.judgement.end() {
            self.overlay.show_split(None);
        }
    }

    /// A hand changes what is seen: judging that was asked for is no longer shown, and goes on by itself later.
    pub(super) fn step_aside(&mut self) {
        let Some(of) = self.judgement.of() else { return };
        let later = self.may_go_on(of);
        if !later && self.judgement.is_under_way() {
            self.leave_verdict(of);
        }
        self.judgement.step_aside(later);
        self.overlay.show_split(None);
        self.draw_again();
    }

    /// Shows the pictures of before and after side by side, or ends that.
    pub(super) fn toggle_split(&mut self) {
        if self.family().is_some() && self.judgement.of().is_none() {
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
}
