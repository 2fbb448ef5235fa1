//! The edit that runs is judged by itself: it begins once its first whole picture is there and no hand has touched the window for a while,
//! steps aside for any hand at once, and goes on with the films that it has.

use std::time::Instant;

use super::record::RowId;
use crate::app::edits::{State, Verdict};
use crate::app::window::session::Session;

/// Judging by itself, at most, without rests: nobody waits for it, and slow devices need more than what a user would wait for.
const SECONDS: f64 = 60.0;

impl Session {
    /// A hand touches the window, or something is saved: the device is needed.
    pub(in crate::app::window) fn touch(&mut self, now: Instant) {
        self.edits.attention.touch(now);
        if self.judgement.has_device() && !self.judgement.is_shown() {
            self.judgement.rest(true);
            self.activity.redraw |= self.panel.open;
        }
    }

    /// When judging is to begin, or go on, by itself; none where there is nothing to judge, or no device for it.
    pub(in crate::app::window) fn judging_due(&self) -> Option<Instant> {
        let busy = self.judgement.has_device() || self.judgement.is_shown() || self.engine.is_compiling_saves();
        if busy || !self.tracing.is_whole() || self.failures.texts().next().is_some() {
            return None;
        }
        self.may_go_on(self.edits.record.running().id).then(|| self.edits.attention.free_at())
    }

    /// Begins to judge, or goes on, if it is time to.
    pub(in crate::app::window) fn attend_judging(&mut self, now: Instant) {
        if self.judging_due().is_none_or(|due| now < due) {
            return;
        }
        let Some((of, sides)) = self.edits.record.to_judge() else { return };
        let place = self.judging_place(SECONDS);
        if self.judgement.is_on(of, &place.scene) {
            self.judgement.rest(false);
        } else {
            self.judgement.start(of, sides, place, false);
            self.edits.record.judge(of, Verdict::new(State::Judging, "judging: compiling both"));
        }
        self.titled = None;
        self.draw_again();
    }

    /// What judging found goes to its row; to the disk, once it is all.
    pub(in crate::app::window) fn record_verdict(&mut self, of: RowId, verdict: Verdict) {
        let (state, short) = (verdict.state, verdict.short.clone());
        if !self.edits.record.judge(of, verdict) || state == State::Judging {
            return;
        }
        self.edits.update(of);
        if !self.judgement.is_shown() {
            let called = self.called(of);
            self.notify(format!("{called}: {short}"));
        }
    }

    /// Whether the judging of a row goes on by itself, once it was interrupted.
    pub(in crate::app::window) fn may_go_on(&self, of: RowId) -> bool {
        let row = self.edits.record.running();
        self.edits.automatic && row.id == of && row.is_to_be_judged() && self.edits.declined != Some(of)
    }

    /// No more will be found of a row for now.
    pub(in crate::app::window) fn leave_verdict(&mut self, of: RowId) {
        self.edits.record.leave(of);
        self.edits.update(of);
    }

    /// A user does not want the row that is judged to be.
    pub(in crate::app::window) fn decline_judging(&mut self) {
        let Some(of) = self.judgement.of() else { return };
        self.edits.declined = Some(of);
        self.leave_verdict(of);
    }

    /// Has edits judged by themselves from now on, or only where that is asked for.
    pub(in crate::app::window) fn set_automatic(&mut self, on: bool) {
        self.edits.automatic = on;
        if on {
            self.edits.declined = None;
        } else if !self.judgement.is_shown() && self.judgement.is_under_way() {
            if let Some(of) = self.judgement.of() {
                self.leave_verdict(of);
            }
            self.end_judging();
        }
        self.activity.working = true;
        self.draw_again();
    }
}
