//! The window's session on a family of scenes: another member is wanted, or was taken up; the last two side by side.

use std::time::Instant;

use super::pair::Seen;
use super::session::Session;
use super::thumbs::Stand;
use crate::engine::Progress;

impl Session {
    /// Wants the member of the family that is `by` places farther.
    pub(super) fn step_member(&mut self, by: i32) {
        match self.family() {
            Some(family) => family.step(by),
            None => return self.notify("one scene: open a variant file to step through its members".to_owned()),
        }
        self.want_member();
    }

    /// Wants the member of a name.
    pub(super) fn choose_member(&mut self, name: &str) {
        if let Some(family) = self.family() {
            family.choose(name);
            self.want_member();
        }
    }

    fn want_member(&mut self) {
        self.follow_list();
        let Some(wanted) = self.members.as_ref().and_then(|members| members.wanted()).map(str::to_owned) else {
            return;
        };
        if self.engine.saved_scene().is_none() {
            return self.notify("no other member can be shown: the files can't be watched".to_owned());
        }
        self.engine.choose_scene();
        self.notify(self.place_of(&wanted));
    }

    /// The list of members as it is now.
    pub(super) fn follow_list(&mut self) {
        self.members = self.family().map(|family| family.listing());
    }

    /// A member's name, and its place among all; the name alone of any other scene.
    pub(super) fn place_of(&self, name: &str) -> String {
        let found = self.members.as_ref().and_then(|members| Some((members.place(name)?, members.names().len())));
        found.map_or_else(|| name.to_owned(), |(place, count)| format!("{name} ({} of {count})", place + 1))
    }

    /// Keeps what is seen of a member, before another may take its place.
    pub(super) fn keep_seen(&mut self) {
        if let Some(seen) = self.seen() {
            self.thumbs.take(&seen, None, Instant::now());
            self.pair.keep(seen);
        }
    }

    /// Makes what is seen of a member small for the panel, while that is open.
    pub(super) fn make_thumb(&mut self, now: Instant) {
        let Some(Progress { spp, finished, .. }) = self.tracing.progress.filter(|_| self.panel.open) else { return };
        let stand = Stand { began: self.tracing.began, spp, finished };
        if self.thumbs.wants(self.name(), stand, now)
            && let Some(seen) = self.seen()
        {
            self.thumbs.take(&seen, Some(stand), now);
        }
    }

    /// What the window shows of a member of a family; none before all of it is there.
    fn seen(&mut self) -> Option<Seen> {
        if self.members.is_none() || !self.tracing.is_whole() {
            return None;
        }
        // What fails here fails in the next step too, and is told there.
        let pixels = self.engine.picture().ok().flatten()?;
        Some(Seen { name: self.name().to_owned(), size: self.engine.window_size(), fit: self.fit(), pixels })
    }

    /// Another member may be shown now. Says which, if it is.
    pub(super) fn follow_member(&mut self) -> Option<String> {
        self.follow_list();
        let name = self.name().to_owned();
        let other = self.members.is_some() && self.pair.follow(&name);
        self.show_pair();
        other.then(|| self.place_of(&name))
    }

    /// Shows the member that was left last beside the one that is shown, or ends that.
    pub(super) fn toggle_pair(&mut self) {
        self.pair.on = !self.pair.on;
        if self.pair.on && self.pair.beside(self.name()).is_none() {
            self.notify("two members side by side, once a second one was shown ([ and ])".to_owned());
        }
        self.show_pair();
        self.draw_again();
    }

    fn show_pair(&mut self) {
        let now = self.name().to_owned();
        self.overlay.show_pair(self.pair.beside(&now), &now);
    }
}
