//! How far a row is, on stderr: a bar on a terminal, nothing elsewhere, for there each row is a line soon enough.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::app::shared::progress::bar_line;

/// Shows how far a row is.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    pub fn new(quiet: bool) -> Self {
        let shown = !quiet && std::io::stderr().is_terminal();
        let target = if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(None, target);
        bar.set_style(ProgressStyle::with_template("{msg}").expect("invariant: the template is a constant"));
        Self { bar }
    }

    /// What a row of this name tells how far it is.
    pub fn of(&self, name: &str) -> impl Fn(f64) + Send + Sync + use<> {
        let (bar, name) = (self.bar.clone(), name.to_owned());
        bar.set_message(bar_line(&name, 0.0, ""));
        move |done| bar.set_message(bar_line(&name, done, ""))
    }

    /// Leaves the line to the table.
    pub fn clear(&self) {
        self.bar.set_message("");
        self.bar.suspend(|| ());
    }
}
